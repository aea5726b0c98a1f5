// SPDX-License-Identifier: MIT
#include "edge/gnss/leap_seconds.h"

#include <array>

namespace plumbline::gnss {
namespace {

using std::chrono::local_days;
using std::chrono::month;
using std::chrono::year;

constexpr local_days first_of(int y, unsigned m) {
  return local_days(year(y) / month(m) / std::chrono::day(1));
}

// The UTC midnights after each leap second since GPS began; the n-th puts GPS n + 1 s ahead.
constexpr std::array kLeapDays = {
    first_of(1981, 7), first_of(1982, 7), first_of(1983, 7), first_of(1985, 7), first_of(1988, 1),
    first_of(1990, 1), first_of(1991, 1), first_of(1992, 7), first_of(1993, 7), first_of(1994, 7),
    first_of(1996, 1), first_of(1997, 7), first_of(1999, 1), first_of(2006, 1), first_of(2009, 1),
    first_of(2012, 7), first_of(2015, 7), first_of(2017, 1)};

constexpr local_days kGpsEpoch = local_days(year(1980) / month(1) / std::chrono::day(6));

}  // namespace

std::chrono::seconds gps_minus_utc(GpsCivilTime gps) {
  std::chrono::seconds ahead{0};
  for (const local_days day : kLeapDays) {
    if (gps >= day + ahead + std::chrono::seconds(1)) ahead += std::chrono::seconds(1);
  }
  return ahead;
}

UtcTime utc_of(GpsCivilTime gps) { return UtcTime(gps.time_since_epoch() - gps_minus_utc(gps)); }

GpsCivilTime gps_time_of(int week, std::chrono::microseconds time_of_week) {
  return kGpsEpoch + std::chrono::weeks(week) + time_of_week;
}

UtcTime utc_of(GpsTime gps) {
  const auto rounded = std::chrono::round<std::chrono::microseconds>(gps.time_since_epoch());
  return utc_of(kGpsEpoch + rounded);
}

std::optional<GpsTime> gps_of(UtcTime utc) {
  constexpr UtcTime kFirst{kGpsEpoch.time_since_epoch()};
  constexpr UtcTime kLast{
      local_days(year(2262) / month(1) / std::chrono::day(1)).time_since_epoch()};
  if (utc < kFirst || utc >= kLast) return std::nullopt;
  std::chrono::seconds ahead{0};
  for (const local_days day : kLeapDays) {
    if (utc.time_since_epoch() >= day.time_since_epoch()) ahead += std::chrono::seconds(1);
  }
  return GpsTime(utc - kFirst + ahead);
}

}  // namespace plumbline::gnss
