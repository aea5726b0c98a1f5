// SPDX-License-Identifier: MIT
#include "edge/gnss/rtklib_parser.h"

#include <gtest/gtest.h>

#include "edge/gnss/time_text.h"

namespace plumbline::gnss {
namespace {

struct Parsed {
  std::vector<GnssFix> fixes;
  DecoderCounters counters;
  std::optional<std::string> refusal;
  bool time_system_named = false;
};

Parsed parse(const std::string& text) {
  Parsed parsed;
  RtklibParser parser([&](const GnssFix& fix) { parsed.fixes.push_back(fix); });
  for (const char c : text) parser.feed({&c, 1});
  parser.finish();
  parsed.counters = parser.counters();
  parsed.refusal = parser.refusal();
  parsed.time_system_named = parser.time_system_named();
  return parsed;
}

std::string header(const std::string& time_system) {
  return "% program   : rnx2rtkp\n"
         "% obs start : 2026/11/20 10:00:18.0 GPST (week2445 468018.0s)\n"
         "% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix,2:float,3:sbas,4:dgps,5:single,6:ppp)\n"
         "%  " +
         time_system +
         "                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   "
         "sdu(m)  sdne(m)  sdeu(m)  sdun(m) age(s)  ratio\n";
}

const std::string kLine =
    "2026/11/20 10:00:18.200   35.668724278  139.762757202    90.2630   1  17   0.0110   0.0120   "
    "0.0250  -0.0050   0.0060  -0.0070   1.20    9.9\n";

TEST(RtklibParser, ReadsAPosLineOfGpsTime) {
  const Parsed parsed = parse(header("GPST") + kLine);
  ASSERT_EQ(parsed.fixes.size(), 1u);
  const GnssFix& fix = parsed.fixes[0];
  EXPECT_EQ(text_of(*fix.time), "2026-11-20T10:00:00.20Z");  // 18 s behind GPS time
  EXPECT_EQ(text_of_day_time(*fix.time_of_day), "T10:00:00.20Z");
  EXPECT_EQ(*fix.latitude_deg, 35.668724278);
  EXPECT_EQ(*fix.longitude_deg, 139.762757202);
  EXPECT_EQ(*fix.height_ellipsoidal_m, 90.2630);
  EXPECT_FALSE(fix.altitude_m);
  EXPECT_EQ(fix.quality, FixQuality::kFixed);
  EXPECT_EQ(*fix.satellites, 17);
  EXPECT_EQ(*fix.correction_age_s, 1.2);
}

TEST(RtklibParser, TurnsSignedSquareRootsIntoCovariancesEastFirst) {
  const Eigen::Matrix3d c = *parse(header("GPST") + kLine).fixes[0].covariance_enu_m2;
  Eigen::Matrix3d expected;
  expected << 144e-6, -25e-6, 36e-6, -25e-6, 121e-6, -49e-6, 36e-6, -49e-6, 625e-6;
  EXPECT_LT((c - expected).cwiseAbs().maxCoeff(), 1e-15) << c;
}

TEST(RtklibParser, KeepsTheVariancesWhereRoundingLeftNoCovarianceMatrix) {
  const Parsed parsed = parse(
      "2026/11/20 10:00:18.2 35.6 139.7 90.2 1 17 0.0001 0.0001 0.0001 0.0001 -0.0001 0.0001 0 "
      "0\n");
  const Eigen::Matrix3d c = *parsed.fixes[0].covariance_enu_m2;
  EXPECT_EQ(c(0, 1), 0.0);
  EXPECT_NEAR(c(0, 0), 1e-8, 1e-20);
}

TEST(RtklibParser, TakesZeroSigmasForNone) {
  const Parsed parsed = parse("2026/11/20 10:00:18.2 35.6 139.7 90.2 5 8 0 0 0 0 0 0 0.00 0.0\n");
  EXPECT_FALSE(parsed.fixes[0].covariance_enu_m2);
}

TEST(RtklibParser, ReadsTheTimeSystemOfTheHeader) {
  EXPECT_EQ(text_of(*parse(header("UTC") + kLine).fixes[0].time), "2026-11-20T10:00:18.20Z");
  EXPECT_EQ(text_of(*parse(header("JST") + kLine).fixes[0].time), "2026-11-20T01:00:18.20Z");
  EXPECT_TRUE(parse(header("UTC") + kLine).time_system_named);
}

TEST(RtklibParser, TakesGpsTimeWhereNothingIsSaidAndTellsSo) {
  const Parsed parsed = parse(kLine);
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-11-20T10:00:00.20Z");
  EXPECT_FALSE(parsed.time_system_named);
}

TEST(RtklibParser, ReadsWeekAndTimeOfWeek) {
  // 2026-11-20 is a Friday: 5 days into week 2445, which began on 2026-11-15.
  const Parsed parsed = parse("2445 468018.200 35.668724278 139.762757202 90.2630 2 17\n");
  ASSERT_EQ(parsed.fixes.size(), 1u);
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-11-20T10:00:00.20Z");
  EXPECT_EQ(parsed.fixes[0].quality, FixQuality::kFloat);
  EXPECT_FALSE(parsed.fixes[0].covariance_enu_m2);
}

TEST(RtklibParser, ReadsCommasAndCarriageReturnsAndMoreColumns) {
  const Parsed parsed = parse(
      "2026/11/20 10:00:18.200, 35.668724278,139.762757202, 90.2630, 4, 17, 0.3, 0.4, 0.5, 0, 0, "
      "0, "
      "1.0, 0.0, 0.1, 0.2, 0.3\r\n");
  ASSERT_EQ(parsed.fixes.size(), 1u);
  EXPECT_EQ(parsed.fixes[0].quality, FixQuality::kDifferential);
  EXPECT_NEAR((*parsed.fixes[0].covariance_enu_m2)(0, 0), 0.16, 1e-15);
}

TEST(RtklibParser, MapsEveryQuality) {
  const FixQuality expected[] = {
      FixQuality::kNone,         FixQuality::kFixed,  FixQuality::kFloat, FixQuality::kDifferential,
      FixQuality::kDifferential, FixQuality::kSingle, FixQuality::kFloat};
  for (int q = 0; q <= 6; ++q) {
    const Parsed parsed =
        parse("2026/11/20 10:00:18.2 35.6 139.7 90.2 " + std::to_string(q) + " 8\n");
    ASSERT_EQ(parsed.fixes.size(), 1u) << q;
    EXPECT_EQ(parsed.fixes[0].quality, expected[q]) << q;
    EXPECT_EQ(parsed.fixes[0].latitude_deg.has_value(), q != 0);
  }
}

TEST(RtklibParser, ReadsALastLineWithoutLineEnd) {
  EXPECT_EQ(parse(kLine.substr(0, kLine.size() - 1)).fixes.size(), 1u);
}

TEST(RtklibParser, CountsLinesItCannotRead) {
  const char* bad[] = {
      "hello\n",
      "2026/13/20 10:00:18.2 35.6 139.7 90.2 1 8\n",
      "2026/02/30 10:00:18.2 35.6 139.7 90.2 1 8\n",
      "2026/11/20 24:00:18.2 35.6 139.7 90.2 1 8\n",
      "2026/11/20 10:00:61.2 35.6 139.7 90.2 1 8\n",
      "2026/11/20 10:00:18.2 95.6 139.7 90.2 1 8\n",
      "2026/11/20 10:00:18.2 35.6 139.7 nan 1 8\n",
      "2026/11/20 10:00:18.2 35.6 139.7 90.2 7 8\n",
      "2026/11/20 10:00:18.2 35.6 139.7 90.2 1\n",
      "2026/11/20 10:00:18.2 35.6 139.7 90.2 1 8 0.01 0.01\n",
      "2445 604800.0 35.6 139.7 90.2 1 8\n",
      "2026/11/20 10:00:18.2 -3957199.2 3310205.1 3737911.7 1 8\n",
  };
  for (const char* line : bad) {
    const Parsed parsed = parse(line);
    EXPECT_EQ(parsed.counters.malformed, 1u) << line;
    EXPECT_TRUE(parsed.fixes.empty()) << line;
  }
}

TEST(RtklibParser, RefusesOtherColumnsInOneSentence) {
  const char* headers[] = {
      "%  GPST                      x-ecef(m)      y-ecef(m)      z-ecef(m)   Q  ns\n",
      "%  GPST                  e-baseline(m)  n-baseline(m)  u-baseline(m)   Q  ns\n",
      "%  GPST                  latitude(d'\")   longitude(d'\")  height(m)   Q  ns\n",
      "% (lat/lon/height=WGS84/geodetic,Q=1:fix,2:float)\n",
  };
  for (const char* line : headers) {
    const Parsed parsed = parse(line + kLine);
    EXPECT_TRUE(parsed.refusal) << line;
    EXPECT_TRUE(parsed.fixes.empty()) << line;
  }
}

}  // namespace
}  // namespace plumbline::gnss
