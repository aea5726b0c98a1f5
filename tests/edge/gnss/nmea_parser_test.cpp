// SPDX-License-Identifier: MIT
#include "edge/gnss/nmea_parser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edge/gnss/time_text.h"
#include "tests/edge/gnss/nmea_text.h"

namespace plumbline::gnss {
namespace {

using std::chrono::milliseconds;

const std::string kGga =
    "GNGGA,100000.20,3540.1234567,N,13945.7654321,E,4,17,1.0,52.140,M,38.123,M,1.2,0001";

std::string gga(const std::string& time, int quality = 4) {
  return sentence("GNGGA," + time + ",3540.1234567,N,13945.7654321,E," + std::to_string(quality) +
                  ",17,1.0,52.140,M,38.123,M,1.2,0001");
}

std::string gst(const std::string& time, const std::string& sigmas = "0.011,0.012,0.025") {
  return sentence("GNGST," + time + ",1.0,,,," + sigmas);
}

TEST(NmeaParser, ReadsEveryDigitOfGga) {
  const Parsed parsed = parse(sentence(kGga));
  ASSERT_EQ(parsed.fixes.size(), 1u);
  const GnssFix& fix = parsed.fixes[0];
  // By hand: 35 + 40.1234567 / 60 and 139 + 45.7654321 / 60.
  EXPECT_NEAR(*fix.latitude_deg, 35.668724278333333, 1e-13);
  EXPECT_NEAR(*fix.longitude_deg, 139.762757201666667, 1e-12);
  EXPECT_EQ(*fix.altitude_m, 52.140);
  EXPECT_EQ(*fix.height_ellipsoidal_m, 90.263);  // 52.140 + 38.123, to the digit
  EXPECT_EQ(fix.quality, FixQuality::kFixed);
  EXPECT_EQ(*fix.satellites, 17);
  EXPECT_EQ(*fix.correction_age_s, 1.2);
  EXPECT_EQ(*fix.time_of_day, std::chrono::hours(10) + milliseconds(200));
  EXPECT_FALSE(fix.time);
  EXPECT_FALSE(fix.covariance_enu_m2);
}

TEST(NmeaParser, TellsPositionsApartThatDifferByTheLastOfEightDecimals) {
  const auto one = parse(sentence("GPGGA,1,3540.12345670,N,13945.7,E,4,17,1.0,1,M,1,M,,"));
  EXPECT_TRUE(one.fixes.empty());  // a time of one digit is none
  const auto a = parse(sentence("GPGGA,100000,3540.12345670,N,13945.7,E,4,17,1.0,1,M,1,M,,"));
  const auto b = parse(sentence("GPGGA,100000,3540.12345671,N,13945.7,E,4,17,1.0,1,M,1,M,,"));
  EXPECT_NEAR(*b.fixes[0].latitude_deg - *a.fixes[0].latitude_deg, 1e-8 / 60, 2e-14);
}

TEST(NmeaParser, GivesSouthAndWestAMinus) {
  const Parsed parsed =
      parse(sentence("GPGGA,100000.00,4552.65403,S,07130.00668,W,1,12,0.64,14.2,M,1.8,M,,"));
  EXPECT_NEAR(*parsed.fixes[0].latitude_deg, -(45 + 52.65403 / 60), 1e-12);
  EXPECT_NEAR(*parsed.fixes[0].longitude_deg, -(71 + 30.00668 / 60), 1e-12);
}

TEST(NmeaParser, AcceptsEveryTalker) {
  for (const char* talker : {"GN", "GP", "GL", "GA", "GB"}) {
    const Parsed parsed = parse(sentence(std::string(talker).append(kGga.substr(2))));
    EXPECT_EQ(parsed.fixes.size(), 1u) << talker;
  }
}

TEST(NmeaParser, HandsOutAnEmptyEpochForAReceiverWithoutSolution) {
  const Parsed parsed = parse(sentence("GPGGA,,,,,,,,,,,,,,") + sentence("GPRMC,,V,,,,,,,,,,N") +
                              sentence("GPGGA,,,,,,,,,,,,,,"));
  ASSERT_EQ(parsed.fixes.size(), 2u);
  EXPECT_EQ(parsed.counters.sentences, 3u);
  EXPECT_EQ(parsed.counters.malformed, 0u);
  EXPECT_EQ(parsed.fixes[0].quality, FixQuality::kNone);
  EXPECT_FALSE(parsed.fixes[0].latitude_deg || parsed.fixes[0].time_of_day);
}

TEST(NmeaParser, GivesNoPositionAtQualityZeroWhateverTheFieldsSay) {
  const Parsed parsed = parse(gga("100000.00", 0));
  EXPECT_FALSE(parsed.fixes[0].latitude_deg || parsed.fixes[0].height_ellipsoidal_m ||
               parsed.fixes[0].altitude_m);
  EXPECT_TRUE(parsed.fixes[0].time_of_day);
}

TEST(NmeaParser, KnowsNoEllipsoidalHeightWithoutTheSeparation) {
  const Parsed parsed =
      parse(sentence("GPGGA,100000.00,4552.65403,N,07130.00668,E,1,12,0.6,14.2,M,,M,,"));
  EXPECT_EQ(*parsed.fixes[0].altitude_m, 14.2);
  EXPECT_FALSE(parsed.fixes[0].height_ellipsoidal_m);
}

TEST(NmeaParser, TakesTheDateFromRmc) {
  const Parsed parsed =
      parse(sentence("GNRMC,100000.20,A,3540.1,N,13945.7,E,0.05,,201126,,,D,V") + gga("100000.20"));
  ASSERT_EQ(parsed.fixes.size(), 1u);
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-11-20T10:00:00.20Z");
  EXPECT_NEAR(parsed.velocity->speed_m_s, 0.05 * 1852 / 3600, 1e-12);
  EXPECT_FALSE(parsed.velocity->course_deg);
}

TEST(NmeaParser, TakesTheDateFromRmcThatComesAfterGgaOfItsEpoch) {
  const Parsed parsed =
      parse(gga("100000.20") + sentence("GNRMC,100000.20,A,3540.1,N,13945.7,E,0,,201126,,,D"));
  ASSERT_EQ(parsed.fixes.size(), 1u);
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-11-20T10:00:00.20Z");
}

TEST(NmeaParser, TakesNoDateFromRmcThatIsNotValid) {
  const Parsed parsed = parse(sentence("GNRMC,100000.20,V,,,,,,,060180,,,N") + gga("100000.20"));
  EXPECT_FALSE(parsed.fixes[0].time);
}

TEST(NmeaParser, TakesTheDateFromZda) {
  const Parsed parsed = parse(sentence("GNZDA,100000.20,20,11,2026,00,00") + gga("100000.20"));
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-11-20T10:00:00.20Z");
  EXPECT_EQ(parse(sentence("GNZDA,,,,,,")).counters.sentences, 1u);
}

TEST(NmeaParser, CarriesTheDateAcrossMidnight) {
  const Parsed parsed = parse(sentence("GNZDA,235959.80,31,12,2026,00,00") + gga("235959.80") +
                              gga("000000.00") + gga("000000.20"));
  ASSERT_EQ(parsed.fixes.size(), 3u);
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-12-31T23:59:59.80Z");
  EXPECT_EQ(text_of(*parsed.fixes[1].time), "2027-01-01T00:00:00.00Z");
  EXPECT_EQ(text_of(*parsed.fixes[2].time), "2027-01-01T00:00:00.20Z");
}

TEST(NmeaParser, DatesTheEpochBeforeMidnightRightWhenTheNextDayIsAlreadyNamed) {
  const Parsed parsed =
      parse(gga("235959.80") + sentence("GNZDA,000000.00,01,01,2027,00,00") + gga("000000.00"));
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2026-12-31T23:59:59.80Z");
}

TEST(NmeaParser, CountsALeapSecondOnIntoTheNextMinute) {
  const Parsed parsed = parse(sentence("GNZDA,235960.50,31,12,2016,00,00") + gga("235960.50"));
  EXPECT_EQ(text_of(*parsed.fixes[0].time), "2017-01-01T00:00:00.50Z");
}

TEST(NmeaParser, TakesSigmasFromGstEastFirst) {
  const Parsed parsed = parse(gga("100000.20") + gst("100000.20"));
  ASSERT_TRUE(parsed.fixes[0].covariance_enu_m2);
  const Eigen::Vector3d sigma = parsed.fixes[0].covariance_enu_m2->diagonal().cwiseSqrt();
  EXPECT_NEAR(sigma.x(), 0.012, 1e-12);  // the sentence says latitude, longitude, height
  EXPECT_NEAR(sigma.y(), 0.011, 1e-12);
  EXPECT_NEAR(sigma.z(), 0.025, 1e-12);
}

TEST(NmeaParser, TakesTheCorrelationFromTheErrorEllipse) {
  // Semi-axes 5 and 3 at 45 degrees: both variances 17, covariance (25 - 9) / 2 = 8.
  const std::string ellipse = "GNGST,100000.20,1.0,5.0,3.0,45.0,4.1231,4.1231,6.0";
  const Parsed parsed = parse(gga("100000.20") + sentence(ellipse));
  EXPECT_NEAR((*parsed.fixes[0].covariance_enu_m2)(0, 1), 8.0, 1e-9);
}

TEST(NmeaParser, IgnoresAnErrorEllipseThatContradictsTheSigmasBesideIt) {
  const std::string ellipse = "GNGST,100000.20,1.0,50.0,3.0,45.0,4.1231,4.1231,6.0";
  const Parsed parsed = parse(gga("100000.20") + sentence(ellipse));
  EXPECT_EQ((*parsed.fixes[0].covariance_enu_m2)(0, 1), 0.0);
}

TEST(NmeaParser, HoldsGstForEpochsBetweenAndThenLetsItGo) {
  std::string log = gga("100000.00") + gst("100000.00");
  for (const char* time : {"100000.20", "100000.80", "100002.00", "100002.20"}) log += gga(time);
  const Parsed parsed = parse(log);
  ASSERT_EQ(parsed.fixes.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(parsed.fixes[i].covariance_enu_m2) << i;
  EXPECT_FALSE(parsed.fixes[4].covariance_enu_m2);
}

TEST(NmeaParser, HoldsNoGstOfAFixedSolutionForAFloatOne) {
  const Parsed parsed = parse(gga("100000.00", 4) + gst("100000.00") + gga("100000.20", 5));
  EXPECT_TRUE(parsed.fixes[0].covariance_enu_m2);
  EXPECT_FALSE(parsed.fixes[1].covariance_enu_m2);
}

TEST(NmeaParser, GivesEachEpochItsOwnGstWhenItComesBeforeGga) {
  const Parsed parsed = parse(gst("100000.00", "1,1,1") + gga("100000.00") +
                              gst("100001.00", "2,2,2") + gga("100001.00"));
  EXPECT_NEAR((*parsed.fixes[0].covariance_enu_m2)(0, 0), 1.0, 1e-12);
  EXPECT_NEAR((*parsed.fixes[1].covariance_enu_m2)(0, 0), 4.0, 1e-12);
}

TEST(NmeaParser, HoldsGstAcrossMidnight) {
  const Parsed parsed = parse(gga("235959.80") + gst("235959.80") + gga("000000.00"));
  EXPECT_TRUE(parsed.fixes[1].covariance_enu_m2);
}

TEST(NmeaParser, TakesGstWithoutSigmasForNoSigma) {
  const Parsed parsed = parse(gga("100000.00") + sentence("GNGST,100000.00,,,,,,,"));
  EXPECT_FALSE(parsed.fixes[0].covariance_enu_m2);
  EXPECT_EQ(parsed.counters.malformed, 0u);
}

TEST(NmeaParser, ReadsGnsWithTheBestOfItsModes) {
  const Parsed parsed = parse(
      sentence("GNGNS,100000.00,3540.1234567,N,13945.7654321,E,ARN,17,1.0,52.140,38.123,1.2,1"));
  ASSERT_EQ(parsed.fixes.size(), 1u);
  EXPECT_EQ(parsed.fixes[0].quality, FixQuality::kFixed);
  EXPECT_EQ(*parsed.fixes[0].height_ellipsoidal_m, 90.263);
}

TEST(NmeaParser, MakesOneEpochOfGgaAndGnsOfOneTime) {
  const Parsed parsed =
      parse(gga("100000.00", 5) +
            sentence("GNGNS,100000.00,3540.1,N,13945.7,E,AA,17,1.0,52.140,38.123,,"));
  ASSERT_EQ(parsed.fixes.size(), 1u);
  EXPECT_EQ(parsed.fixes[0].quality, FixQuality::kFloat);
}

TEST(NmeaParser, LetsRmcStandInOnlyWhereThereIsNoGga) {
  const std::string rmc = sentence("GPRMC,100001.00,A,3540.1,N,13945.7,E,3.0,90.0,201126,,,A");
  const Parsed alone = parse(rmc);
  ASSERT_EQ(alone.fixes.size(), 1u);
  EXPECT_EQ(alone.fixes[0].quality, FixQuality::kSingle);
  EXPECT_FALSE(alone.fixes[0].height_ellipsoidal_m);
  EXPECT_EQ(parse(gga("100000.00") + rmc).fixes.size(), 1u);
}

TEST(NmeaParser, ReadsSpeedAndCourseFromVtg) {
  const Parsed parsed = parse(sentence("GNVTG,271.54,T,,M,1.00,N,1.85,K,A"));
  EXPECT_NEAR(parsed.velocity->speed_m_s, 1852.0 / 3600, 1e-12);
  EXPECT_EQ(*parsed.velocity->course_deg, 271.54);
  EXPECT_FALSE(parse(sentence("GNVTG,,T,,M,0.01,N,0.02,K,A")).velocity->course_deg);
}

TEST(NmeaParser, ReadsTheBasePositionOfReach) {
  const Parsed parsed = parse(sentence("GNEBP,3540.1234567,N,13945.7654321,E,90.2630,M"));
  ASSERT_TRUE(parsed.base);
  EXPECT_NEAR(parsed.base->latitude_deg, 35.668724278333333, 1e-13);
  EXPECT_EQ(*parsed.base->height_ellipsoidal_m, 90.263);
  const Parsed empty = parse("$GNEBP,,,,,,M*13\r\n");  // as recorded
  EXPECT_FALSE(empty.base);
  EXPECT_EQ(empty.counters.sentences, 1u);
}

TEST(NmeaParser, GivesTheSameFixesInPiecesOfAnySize) {
  std::string log = sentence("GNZDA,100000.00,20,11,2026,00,00");
  for (const char* time : {"100000.00", "100000.20", "100000.40"}) log += gga(time) + gst(time);
  for (const std::size_t piece : {1u, 2u, 7u, 64u}) {
    const Parsed parsed = parse(log, piece);
    EXPECT_EQ(parsed.fixes.size(), 3u) << piece;
    EXPECT_EQ(parsed.counters.bytes, log.size());
    EXPECT_EQ(parsed.counters.sentences, 7u);
    EXPECT_EQ(parsed.counters.epochs, 3u);
  }
}

TEST(NmeaParser, HandsOutTheEpochBegunWhenTheBurstIsOver) {
  int fixes = 0;
  NmeaParser parser([&](const GnssFix&) { ++fixes; });
  parser.feed(gga("100000.00"));
  EXPECT_EQ(fixes, 0);
  parser.flush();
  EXPECT_EQ(fixes, 1);
  parser.finish();
  EXPECT_EQ(fixes, 1);
}

struct Malformation {
  const char* why;
  std::string body;
};

TEST(NmeaParser, CountsAsMalformedWhatHasAGoodChecksumButSaysNothing) {
  const Malformation cases[] = {
      {"GGA of 13 fields", "GPGGA,100000.00,3540.1,N,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2"},
      {"latitude over 90", "GPGGA,100000.00,9140.1,N,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"minutes of 60", "GPGGA,100000.00,3560.0,N,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"no hemisphere", "GPGGA,100000.00,3540.1,,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"wrong hemisphere", "GPGGA,100000.00,3540.1,E,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"latitude without longitude", "GPGGA,100000.00,3540.1,N,,,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"hour 24", "GPGGA,240000.00,3540.1,N,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"second 61", "GPGGA,100061.00,3540.1,N,13945.7,E,4,17,1.0,52.1,M,38.1,M,1.2,1"},
      {"a word for a height", "GPGGA,100000.00,3540.1,N,13945.7,E,4,17,1.0,nan,M,38.1,M,1.2,1"},
      {"an exponent", "GPGGA,100000.00,3540.1,N,13945.7,E,4,17,1.0,5e1,M,38.1,M,1.2,1"},
      {"feet", "GPGGA,100000.00,3540.1,N,13945.7,E,4,17,1.0,52.1,F,38.1,M,1.2,1"},
      {"two digits of quality", "GPGGA,100000.00,3540.1,N,13945.7,E,44,17,1.0,52.1,M,38.1,M,1,1"},
      {"a blank in a number", "GPGGA,100000.00,3540.1,N,13945.7,E,4,17,1.0, 52.1,M,38.1,M,1,1"},
      {"GST of 7 fields", "GNGST,100000.00,1.0,,,,0.011,0.012"},
      {"a negative sigma", "GNGST,100000.00,1.0,,,,-0.011,0.012,0.025"},
      {"RMC of 10 fields", "GNRMC,100000.00,A,3540.1,N,13945.7,E,0.0,,201126,"},
      {"the 30th of February", "GNRMC,100000.00,A,3540.1,N,13945.7,E,0.0,,300226,,,A"},
      {"a date of 5 digits", "GNRMC,100000.00,A,3540.1,N,13945.7,E,0.0,,20112,,,A"},
      {"an unknown status", "GNRMC,100000.00,X,3540.1,N,13945.7,E,0.0,,201126,,,A"},
      {"ZDA without a month", "GNZDA,100000.00,20,,2026,00,00"},
      {"VTG of 5 fields", "GNVTG,271.54,T,,M,1.00"},
      {"EBP in feet", "GNEBP,3540.1,N,13945.7,E,90.2,F"},
      {"an unknown GNS mode", "GNGNS,100000.00,3540.1,N,13945.7,E,AZ,17,1.0,52.1,38.1,,"},
  };
  for (const Malformation& bad : cases) {
    const Parsed parsed = parse(sentence(bad.body));
    EXPECT_EQ(parsed.counters.malformed, 1u) << bad.why;
    EXPECT_EQ(parsed.counters.sentences, 0u) << bad.why;
    EXPECT_TRUE(parsed.fixes.empty()) << bad.why;
  }
}

TEST(NmeaParser, CountsBrokenFramesAndGoesOnWithTheNextSentence) {
  const std::string good = sentence(kGga);
  const Malformation frames[] = {
      {"no checksum", std::string("$").append(kGga).append("\r\n")},
      {"cut by the next sentence", good.substr(0, 40)},
      {"cut by the end of the line", good.substr(0, 40) + "\r\n"},
      {"one digit of checksum", good.substr(0, good.size() - 3) + "\r\n"},
      {"text behind the checksum", good.substr(0, good.size() - 2) + "x\r\n"},
      {"endless", std::string("$GPGGA,").append(400, '1').append("\r\n")},
      {"a binary byte within", std::string("$GPGGA,10\x80").append(kGga).append("\r\n")},
  };
  for (const Malformation& frame : frames) {
    const Parsed parsed = parse(frame.body + good);
    EXPECT_EQ(parsed.counters.malformed, 1u) << frame.why;
    EXPECT_EQ(parsed.fixes.size(), 1u) << frame.why;
  }
}

TEST(NmeaParser, LeavesOtherTalkersAndProprietarySentencesInPeace) {
  const Parsed parsed = parse(sentence("PUBX,00,081350.00,4717.113210,N") +
                              sentence("GPGSV,3,1,12,05,06,110,19") + sentence("GNTXT,hello"));
  EXPECT_EQ(parsed.counters.sentences, 3u);
  EXPECT_EQ(parsed.counters.malformed, 0u);
  EXPECT_TRUE(parsed.fixes.empty());
}

}  // namespace
}  // namespace plumbline::gnss
