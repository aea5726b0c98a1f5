// SPDX-License-Identifier: MIT
#include "edge/gnss/log_parser.h"

#include <gtest/gtest.h>

#include "edge/gnss/log_shape.h"
#include "tests/edge/gnss/nmea_text.h"

namespace plumbline::gnss {
namespace {

using std::chrono::milliseconds;

struct Read {
  int fixes = 0;
  LogKind kind = LogKind::kUnknown;
  DecoderCounters counters;
  std::string reason;
};

Read read(const std::string& text) {
  Read result;
  LogParser parser([&](const GnssFix&) { ++result.fixes; });
  parser.feed(text);
  parser.finish();
  result.kind = parser.kind();
  result.counters = parser.counters();
  result.reason = parser.reason_for_nothing();
  return result;
}

TEST(LogParser, TellsNmeaFromRtklibByContent) {
  const Read nmea = read(sentence("GPGGA,100000,3540.1,N,13945.7,E,4,17,1.0,1,M,1,M,,"));
  EXPECT_EQ(nmea.kind, LogKind::kNmea);
  EXPECT_EQ(nmea.fixes, 1);
  const Read pos = read("2026/11/20 10:00:18.2 35.6 139.7 90.2 1 8\n");
  EXPECT_EQ(pos.kind, LogKind::kRtklib);
  EXPECT_EQ(pos.fixes, 1);
  EXPECT_EQ(pos.counters.sentences, 1u);
}

TEST(LogParser, SaysWhyNothingCameOut) {
  EXPECT_EQ(read("").reason, "is empty");
  EXPECT_NE(read("once upon a time\n").reason.find("neither NMEA"), std::string::npos);
  EXPECT_NE(read(sentence("GPGSV,1,1,00")).reason.find("no GGA"), std::string::npos);
  EXPECT_NE(read("$GPGGA,1*00\r\n").reason.find("1 with a bad checksum"), std::string::npos);
  EXPECT_NE(read("%  GPST  x-ecef(m)\n").reason.find("ECEF"), std::string::npos);
}

std::vector<GnssFix> fixes_at(const std::vector<int>& times_ms) {
  std::vector<GnssFix> fixes;
  for (const int time : times_ms) {
    GnssFix fix;
    fix.time = UtcTime(milliseconds(time));
    fix.time_of_day = milliseconds(time);
    fixes.push_back(fix);
  }
  return fixes;
}

TEST(LogShape, TakesARegularLogWithGapsForEpochs) {
  EXPECT_FALSE(looks_like_time_marks(fixes_at({0, 200, 400, 1000, 1200, 1400, 9600, 9800})));
  EXPECT_FALSE(looks_like_time_marks(fixes_at({0, 1000, 2000, 3000, 5000})));
}

TEST(LogShape, TakesExposuresForTimeMarks) {
  EXPECT_TRUE(looks_like_time_marks(fixes_at({123, 4567, 9831, 14222, 19940})));
  EXPECT_TRUE(looks_like_time_marks(fixes_at({0, 5000, 10000, 15000})));
  EXPECT_TRUE(looks_like_time_marks(fixes_at({13, 541, 1172, 1817, 2366, 3031})));
}

TEST(LogShape, DatesEpochsBeforeTheFirstDateAcrossMidnight) {
  std::vector<GnssFix> fixes(3);
  fixes[0].time_of_day = std::chrono::hours(24) - milliseconds(400);
  fixes[1].time_of_day = milliseconds(0);
  fixes[2].time_of_day = milliseconds(400);
  const UtcTime dated =
      std::chrono::sys_days(std::chrono::year(2026) / 11 / 21) + milliseconds(400);
  fixes[2].time = dated;
  EXPECT_EQ(complete_dates(fixes), DateState::kCompleted);
  EXPECT_EQ(*fixes[1].time, dated - milliseconds(400));
  EXPECT_EQ(*fixes[0].time, dated - milliseconds(800));
}

TEST(LogShape, CountsDaysWhereNoDateIsKnown) {
  std::vector<GnssFix> fixes(2);
  fixes[0].time_of_day = std::chrono::hours(24) - milliseconds(400);
  fixes[1].time_of_day = milliseconds(0);
  EXPECT_EQ(complete_dates(fixes), DateState::kUnknown);
  EXPECT_EQ(*fixes[1].time - *fixes[0].time, milliseconds(400));
}

}  // namespace
}  // namespace plumbline::gnss
