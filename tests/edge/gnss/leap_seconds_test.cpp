// SPDX-License-Identifier: MIT
#include "edge/gnss/leap_seconds.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iostream>
#include <sstream>

namespace plumbline::gnss {
namespace {

using std::chrono::seconds;

// The list that IERS and NIST publish and every system carries: seconds since 1900, TAI minus UTC.
TEST(LeapSeconds, AgreeWithTheListOfTheSystem) {
  std::ifstream list("/usr/share/zoneinfo/leap-seconds.list");
  if (!list) {
    std::cout << "no leap-seconds.list on this system (package tzdata)\n";
    GTEST_SKIP() << "no leap-seconds.list on this system";
  }
  constexpr std::int64_t k1900To1970 = 2208988800;
  constexpr std::int64_t kTaiMinusGps = 19;
  const std::int64_t gps_began = 315964800;  // 1980-01-06
  int compared = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream columns(line);
    std::int64_t since_1900 = 0;
    std::int64_t tai_minus_utc = 0;
    columns >> since_1900 >> tai_minus_utc;
    const std::int64_t utc = since_1900 - k1900To1970;
    if (utc <= gps_began) continue;
    const std::int64_t ahead = tai_minus_utc - kTaiMinusGps;
    const GpsCivilTime from{seconds(utc + ahead)};
    EXPECT_EQ(gps_minus_utc(from).count(), ahead) << line;
    EXPECT_EQ(gps_minus_utc(from - seconds(2)).count(), ahead - 1) << line;
    EXPECT_EQ(utc_of(from), UtcTime(seconds(utc))) << line;
    ++compared;
  }
  EXPECT_EQ(compared, 18);
}

TEST(LeapSeconds, AreEighteenIn2026) {
  const auto day = std::chrono::local_days(std::chrono::year(2026) / 11 / 20);
  EXPECT_EQ(gps_minus_utc(day), seconds(18));
}

TEST(GpsWeek, BeginsOnSundays) {
  EXPECT_EQ(gps_time_of(0, seconds(0)), std::chrono::local_days(std::chrono::year(1980) / 1 / 6));
  // Week 2048 began on 2019-04-07, when ten-bit week counters rolled over for the second time.
  EXPECT_EQ(gps_time_of(2048, seconds(0)),
            std::chrono::local_days(std::chrono::year(2019) / 4 / 7));
}

// Week 1930 began on Sunday 2017-01-01 in GPS time, then 17 s ahead of UTC; the second 23:59:60 of
// 2016-12-31 UTC was its eighteenth.
TEST(GpsClockAndUtc, GoThroughTheLeapSecondOf2016) {
  using std::chrono::milliseconds;
  const GpsTime week_1930{std::chrono::weeks(1930)};  // 2017-01-01 00:00:00 GPS = 23:59:43 UTC
  const UtcTime midnight{std::chrono::sys_days(std::chrono::year(2017) / 1 / 1)};
  EXPECT_EQ(utc_of(week_1930), midnight - seconds(17));
  EXPECT_EQ(gps_of(midnight - milliseconds(1)), week_1930 + seconds(17) - milliseconds(1));
  EXPECT_EQ(gps_of(midnight), week_1930 + seconds(18));
  EXPECT_EQ(utc_of(week_1930 + seconds(17) - milliseconds(1)), midnight - milliseconds(1));
  EXPECT_EQ(utc_of(week_1930 + seconds(17)), midnight);  // the inserted second
  EXPECT_EQ(utc_of(week_1930 + seconds(18)), midnight);
  EXPECT_EQ(utc_of(week_1930 + seconds(19)), midnight + seconds(1));
}

TEST(GpsClockAndUtc, AreInversesAwayFromInsertedSeconds) {
  const UtcTime first{std::chrono::sys_days(std::chrono::year(1980) / 1 / 6)};
  const auto step = std::chrono::hours(24 * 9) + std::chrono::microseconds(7654321);
  int steps = 0;
  for (UtcTime utc = first; utc < first + std::chrono::years(80); utc += step, ++steps) {
    const auto gps = gps_of(utc);
    ASSERT_TRUE(gps);
    ASSERT_EQ(utc_of(*gps), utc);
  }
  EXPECT_GT(steps, 3000);
}

TEST(GpsClockAndUtc, GoOverTheWeekRolloverWithoutASeam) {
  // Week 2048, in which ten-bit counters show 0 again: 2019-04-07 00:00:00 GPS, 18 s ahead of UTC.
  const UtcTime utc{std::chrono::sys_days(std::chrono::year(2019) / 4 / 6) +
                    std::chrono::hours(24) - seconds(18)};
  EXPECT_EQ(gps_of(utc), GpsTime(std::chrono::weeks(2048)));
  EXPECT_EQ(*gps_of(utc) - *gps_of(utc - std::chrono::microseconds(1)),
            std::chrono::microseconds(1));
}

TEST(GpsClockAndUtc, RoundToTheNearestMicrosecond) {
  const GpsTime gps{std::chrono::weeks(2400)};
  EXPECT_EQ(utc_of(gps + std::chrono::nanoseconds(1499)),
            utc_of(gps) + std::chrono::microseconds(1));
  EXPECT_EQ(utc_of(gps + std::chrono::nanoseconds(1501)),
            utc_of(gps) + std::chrono::microseconds(2));
}

TEST(GpsClockAndUtc, RefuseWhatIsBeforeGpsOrBeyondItsClock) {
  const UtcTime first{std::chrono::sys_days(std::chrono::year(1980) / 1 / 6)};
  EXPECT_EQ(gps_of(first), GpsTime());
  EXPECT_FALSE(gps_of(first - std::chrono::microseconds(1)));
  EXPECT_FALSE(gps_of(UtcTime::min()));
  EXPECT_FALSE(gps_of(UtcTime::max()));
}

}  // namespace
}  // namespace plumbline::gnss
