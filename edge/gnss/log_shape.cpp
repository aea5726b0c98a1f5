// SPDX-License-Identifier: MIT
#include "edge/gnss/log_shape.h"

#include <algorithm>
#include <cstdlib>

#include "edge/base/median.h"

namespace plumbline::gnss {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr microseconds kHalfDay = std::chrono::hours(12);
constexpr microseconds kWholeDay = std::chrono::hours(24);
constexpr microseconds kGridTolerance = milliseconds(2);

std::vector<microseconds> intervals_of(const std::vector<GnssFix>& fixes) {
  std::vector<microseconds> intervals;
  for (std::size_t i = 1; i < fixes.size(); ++i) {
    if (fixes[i].time && fixes[i - 1].time) {
      intervals.push_back(*fixes[i].time - *fixes[i - 1].time);
    }
  }
  return intervals;
}

bool on_grid(microseconds interval, microseconds step) {
  const microseconds rest = interval % step;
  return std::min(rest, step - rest) <= kGridTolerance;
}

bool mostly_on_grid(const std::vector<microseconds>& intervals, microseconds step) {
  const auto on = std::count_if(intervals.begin(), intervals.end(), [step](microseconds i) {
    return i.count() > 0 && on_grid(i, step);
  });
  return 10 * static_cast<std::size_t>(on) >= 8 * intervals.size();
}

// The time of day, on the day that puts it nearest to `other`.
UtcTime near(microseconds time_of_day, UtcTime other) {
  UtcTime time = std::chrono::floor<std::chrono::days>(other) + time_of_day;
  if (time - other > kHalfDay) time -= kWholeDay;
  if (other - time > kHalfDay) time += kWholeDay;
  return time;
}

void date_backwards(std::vector<GnssFix>& fixes, std::size_t first_dated) {
  UtcTime later = *fixes[first_dated].time;
  for (std::size_t i = first_dated; i-- > 0;) {
    if (!fixes[i].time_of_day) continue;
    later = near(*fixes[i].time_of_day, later);
    fixes[i].time = later;
  }
}

void count_days(std::vector<GnssFix>& fixes) {
  std::optional<UtcTime> before;
  for (GnssFix& fix : fixes) {
    if (!fix.time_of_day) continue;
    fix.time = before ? near(*fix.time_of_day, *before) : UtcTime(*fix.time_of_day);
    before = fix.time;
  }
}

}  // namespace

bool looks_like_time_marks(const std::vector<GnssFix>& fixes, microseconds slowest_epochs) {
  const std::vector<microseconds> intervals = intervals_of(fixes);
  if (intervals.empty() || upper_median(intervals) > slowest_epochs) return true;
  // The usual rates of receivers, 20 Hz to 1 Hz; a grid of 50 ms holds those of 100 ms and so on.
  constexpr microseconds kSteps[] = {milliseconds(50), milliseconds(125)};
  return std::none_of(std::begin(kSteps), std::end(kSteps),
                      [&](microseconds step) { return mostly_on_grid(intervals, step); });
}

DateState complete_dates(std::vector<GnssFix>& fixes) {
  const auto dated = [](const GnssFix& fix) { return fix.time.has_value(); };
  const auto first = std::find_if(fixes.begin(), fixes.end(), dated);
  if (first == fixes.end()) {
    count_days(fixes);
    return DateState::kUnknown;
  }
  if (first == fixes.begin()) return DateState::kKnown;
  date_backwards(fixes, static_cast<std::size_t>(first - fixes.begin()));
  return DateState::kCompleted;
}

}  // namespace plumbline::gnss
