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

}  // namespace
}  // namespace plumbline::gnss
