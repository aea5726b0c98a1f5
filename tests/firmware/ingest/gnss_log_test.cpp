// SPDX-License-Identifier: MIT
#include "firmware/ingest/gnss_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>

#include "edge/gnss/time_text.h"

namespace plumbline::ingest {
namespace {

using std::chrono::microseconds;

const UtcTime kTenOClock =
    std::chrono::sys_days(std::chrono::year(2026) / 11 / 20) + std::chrono::hours(10);
const geodesy::Geodetic kFoot{35.668724278, 139.762757202, 90.263};

UtcTime at_s(double t_s) { return kTenOClock + microseconds(std::llround(t_s * 1e6)); }

// A climb of 2 m/s with some sway.
Eigen::Vector3d climb(double t_s) {
  return {0.6 * std::sin(1.1 * t_s), 0.5 * std::cos(0.9 * t_s), 2.0 * t_s + 0.8 * std::sin(t_s)};
}

geodesy::LocalFrame foot() { return *geodesy::LocalFrame::at(kFoot); }

std::string sentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char ending[8];
  std::snprintf(ending, sizeof ending, "*%02X\r\n", sum);
  return std::string("$").append(body).append(ending);
}

std::string nmea_time(double t_s) {
  const auto of_day = at_s(t_s) - std::chrono::floor<std::chrono::days>(kTenOClock);
  const std::chrono::hh_mm_ss hms(of_day);
  char text[32];
  std::snprintf(text, sizeof text, "%02d%02d%02d.%02d", static_cast<int>(hms.hours().count()),
                static_cast<int>(hms.minutes().count()), static_cast<int>(hms.seconds().count()),
                static_cast<int>(hms.subseconds().count() / 10000));
  return text;
}

std::string gga(double t_s, const geodesy::Geodetic& place) {
  char text[160];
  const double lat_min = (place.latitude_deg - 35) * 60;
  const double lon_min = (place.longitude_deg - 139) * 60;
  std::snprintf(text, sizeof text,
                "GNGGA,%s,35%010.7f,N,139%010.7f,E,4,17,1.0,%.3f,M,38.123,M,1.2,0001",
                nmea_time(t_s).c_str(), lat_min, lon_min, place.height_ellipsoidal_m - 38.123);
  return sentence(text);
}

enum class Date { kRmc, kNone };

// A minute of a receiver at 5 Hz with GST and RMC at 1 Hz, as Reach sends them.
std::string nmea_log(Date date, double length_s = 60,
                     const std::string& sigmas = ",,,,,0.010,0.010,0.020") {
  std::string log;
  for (int i = 0; i <= static_cast<int>(length_s * 5); ++i) {
    const double t = i / 5.0;
    if (i % 5 == 0 && date == Date::kRmc) {
      log += sentence("GNRMC," + nmea_time(t) + ",A,3540.1,N,13945.7,E,0.0,,201126,,,D");
    }
    log += gga(t, foot().geodetic_of(climb(t)));
    if (i % 5 == 0 && !sigmas.empty()) log += sentence("GNGST," + nmea_time(t) + sigmas);
  }
  return log;
}

// The same in RTKLIB's format, GPS time.
std::string pos_lines(const std::vector<double>& times_s) {
  std::string text =
      "% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix)\n"
      "%  GPST   latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   sdu(m)\n";
  for (const double t : times_s) {
    const geodesy::Geodetic place = foot().geodetic_of(climb(t));
    const std::string stamp = gnss::text_of(at_s(t + 18));
    char line[200];
    std::snprintf(line, sizeof line,
                  "2026/11/20 %s0 %.9f %.9f %.4f 1 17 0.011 0.012 0.025 0 0 0 1.0 9.9\n",
                  stamp.substr(11, stamp.size() - 12).c_str(), place.latitude_deg,
                  place.longitude_deg, place.height_ellipsoidal_m);
    text += line;
  }
  return text;
}

class GnssLogFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("gnss_log_test_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  GnssLog log(const std::string& name, const std::string& text) {
    auto read = read_gnss_log(file(name, text));
    EXPECT_TRUE(read) << (read ? "" : read.error().sentence);
    return *read;
  }

 private:
  std::filesystem::path folder_;
};

constexpr std::chrono::minutes kJapan(540);

PhotoMoment photo(double t_s, std::optional<std::chrono::minutes> zone = kJapan) {
  PhotoMoment moment;
  moment.name = "P" + std::to_string(static_cast<int>(t_s)) + ".JPG";
  moment.time.camera_clock = at_s(t_s) + kJapan;
  moment.time.has_subseconds = true;
  moment.time.offset = zone;
  return moment;
}

std::vector<PhotoMoment> photos(const std::vector<double>& times_s,
                                std::optional<std::chrono::minutes> zone = kJapan) {
  std::vector<PhotoMoment> moments;
  for (const double t : times_s) moments.push_back(photo(t, zone));
  return moments;
}

const std::vector<double> kExposures = {3.11, 9.87, 16.02, 21.55, 30.7, 38.23, 44.44, 51.9};
const TimeOffset kExact{0, 0};

double error_m(const AntennaAtPhoto& at, double t_s) {
  return (foot().enu_of(at.position) - climb(t_s)).norm();
}

bool mentions(const std::string& sentence, const std::string& what) {
  return sentence.find(what) != std::string::npos;
}

bool any_mentions(const std::vector<std::string>& sentences, const std::string& what) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& s) { return mentions(s, what); });
}

TEST_F(GnssLogFile, FindsTheAntennaInANmeaLogWhateverItsName) {
  for (const char* name : {"flight.nmea", "flight.txt", "flight.pos"}) {
    const auto found =
        antenna_at_photos(log(name, nmea_log(Date::kRmc)), photos(kExposures), kExact);
    ASSERT_TRUE(found) << found.error().sentence;
    for (std::size_t i = 0; i < kExposures.size(); ++i) {
      ASSERT_TRUE(found->photos[i]);
      EXPECT_LT(error_m(*found->photos[i], kExposures[i]), 0.003);
      EXPECT_EQ(found->photos[i]->quality, FixQuality::kFixed);
      EXPECT_EQ(found->photos[i]->utc, at_s(kExposures[i]));
      EXPECT_FALSE(found->photos[i]->sigma_assumed);
    }
    EXPECT_TRUE(found->warnings.empty());
  }
}

TEST_F(GnssLogFile, FindsTheAntennaInAPosOfGpsTime) {
  std::vector<double> epochs;
  for (int i = 0; i <= 300; ++i) epochs.push_back(i / 5.0);
  const GnssLog pos = log("ppk.llh", pos_lines(epochs));
  EXPECT_FALSE(pos.time_marks);
  const auto found = antenna_at_photos(pos, photos(kExposures), kExact);
  ASSERT_TRUE(found) << found.error().sentence;
  for (std::size_t i = 0; i < kExposures.size(); ++i) {
    EXPECT_LT(error_m(*found->photos[i], kExposures[i]), 0.003);
    EXPECT_NEAR(std::sqrt(found->photos[i]->covariance_enu_m2(0, 0)), 0.012, 0.001);
  }
}

TEST_F(GnssLogFile, AddsTheTimeOffsetToTheCamerasClock) {
  std::vector<PhotoMoment> late = photos(kExposures);
  for (PhotoMoment& moment : late) *moment.time.camera_clock += std::chrono::milliseconds(730);
  const auto found =
      antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)), late, TimeOffset{-0.73, 0});
  ASSERT_TRUE(found);
  EXPECT_LT(error_m(*found->photos[2], kExposures[2]), 0.003);
}

TEST_F(GnssLogFile, AsksForAnAmbiguousHourAndNamesTheOneThatFits) {
  const auto found = antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)),
                                       photos(kExposures, std::nullopt), std::nullopt);
  ASSERT_FALSE(found);
  EXPECT_TRUE(mentions(found.error().sentence, "--time-offset"));
  EXPECT_TRUE(mentions(found.error().sentence, "'a.nmea' with -32400."));
}

TEST_F(GnssLogFile, TakesTheHourFromTheTimeOffset) {
  const auto found = antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)),
                                       photos(kExposures, std::nullopt), TimeOffset{-32400, 0});
  ASSERT_TRUE(found) << found.error().sentence;
  EXPECT_LT(error_m(*found->photos[0], kExposures[0]), 0.003);
}

TEST_F(GnssLogFile, TakesTheHourFromThePhotosGpsTime) {
  std::vector<PhotoMoment> moments = photos(kExposures, std::nullopt);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    moments[i].time.gps = std::chrono::floor<std::chrono::seconds>(at_s(kExposures[i]));
  }
  const GnssLog nmea = log("a.nmea", nmea_log(Date::kRmc));
  for (const TimeOffset& offset : {TimeOffset{0, 0}, TimeOffset{-32400, 0}}) {
    const auto found = antenna_at_photos(nmea, moments, offset);
    ASSERT_TRUE(found) << found.error().sentence;
    EXPECT_LT(error_m(*found->photos[0], kExposures[0]), 0.003);
  }
}

// By hand, the derivative of climb().
double climb_m_s(double seconds) { return 2.0 + 0.8 * std::cos(seconds); }

TEST_F(GnssLogFile, LeavesTheSigmaOfTheOffsetToBeOneErrorOfAllPhotos) {
  const GnssLog nmea = log("a.nmea", nmea_log(Date::kRmc));
  const auto sharp = antenna_at_photos(nmea, photos({20.1}), TimeOffset{0, 0});
  const auto blurred = antenna_at_photos(nmea, photos({20.1}), TimeOffset{0, 0.1});
  EXPECT_EQ(sharp->common_time_sigma_s, 0);
  EXPECT_EQ(blurred->common_time_sigma_s, 0.1);
  EXPECT_EQ(blurred->photos[0]->covariance_enu_m2, sharp->photos[0]->covariance_enu_m2);
  EXPECT_NEAR((*blurred->photos[0]->velocity_enu_m_s).z(), climb_m_s(20.1), 0.02);
}

TEST_F(GnssLogFile, PutsWhatACutStampLeavesOpenIntoThePositionAlongTheVelocity) {
  const GnssLog nmea = log("a.nmea", nmea_log(Date::kRmc));
  std::vector<PhotoMoment> cut = photos({20.0});
  cut[0].time.has_subseconds = false;
  const auto sharp = antenna_at_photos(nmea, photos({20.0}), TimeOffset{0, 0.1});
  const auto blurred = antenna_at_photos(nmea, cut, TimeOffset{0, 0.1});
  EXPECT_EQ(blurred->common_time_sigma_s, 0.1);
  const Eigen::Matrix3d added =
      blurred->photos[0]->covariance_enu_m2 - sharp->photos[0]->covariance_enu_m2;
  EXPECT_NEAR(std::sqrt(added(2, 2)), climb_m_s(20.0) / std::sqrt(12.0), 0.01);
}

TEST_F(GnssLogFile, SaysWhatItAssumedOfTheClock) {
  const auto found =
      antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)), photos({20.1}), std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_TRUE(any_mentions(found->warnings, "0.1 s"));
  EXPECT_EQ(found->common_time_sigma_s, 0.1);
}

TEST_F(GnssLogFile, AddsHalfASecondToStampsCutToWholeSeconds) {
  std::vector<PhotoMoment> moments = photos({20.0});
  moments[0].time.has_subseconds = false;
  const GnssLog nmea = log("a.nmea", nmea_log(Date::kRmc));
  const auto found = antenna_at_photos(nmea, moments, std::nullopt);
  EXPECT_EQ(found->photos[0]->utc, at_s(20.5));
  EXPECT_TRUE(any_mentions(found->warnings, "whole seconds"));
  EXPECT_EQ(antenna_at_photos(nmea, moments, kExact)->photos[0]->utc, at_s(20.0));
}

TEST_F(GnssLogFile, LeavesPhotosOutsideTheLogEmptyAndNamesThem) {
  const auto found =
      antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)), photos({20.1, 70.5, 30.3}), kExact);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->photos[0] && found->photos[2]);
  EXPECT_FALSE(found->photos[1]);
  EXPECT_TRUE(any_mentions(found->warnings, "1 of 3 photos"));
  EXPECT_TRUE(any_mentions(found->warnings, "P70.JPG"));
}

TEST_F(GnssLogFile, FailsWhereNoPhotoFallsIntoTheLog) {
  const auto found =
      antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)), photos({500, 600}), kExact);
  ASSERT_FALSE(found);
  EXPECT_TRUE(mentions(found.error().sentence, "2026-11-20T10:08:20.00Z"));
  EXPECT_TRUE(mentions(found.error().sentence, "--time-offset"));
}

TEST_F(GnssLogFile, FailsWhereNoPhotoHasATime) {
  const auto found =
      antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc)), {{"a.jpg", {}}, {"b.jpg", {}}}, {});
  ASSERT_FALSE(found);
  EXPECT_TRUE(mentions(found.error().sentence, "DateTimeOriginal"));
}

TEST_F(GnssLogFile, MatchesALogWithoutDatesByTimeOfDay) {
  const GnssLog undated = log("a.nmea", nmea_log(Date::kNone));
  EXPECT_FALSE(undated.date_known);
  const auto found = antenna_at_photos(undated, photos(kExposures), kExact);
  ASSERT_TRUE(found) << found.error().sentence;
  EXPECT_LT(error_m(*found->photos[0], kExposures[0]), 0.003);
  EXPECT_TRUE(any_mentions(found->warnings, "without a date"));
}

TEST_F(GnssLogFile, AssumesUsualSigmasWhereNoneIsStatedAndSaysSo) {
  const auto found =
      antenna_at_photos(log("a.nmea", nmea_log(Date::kRmc, 60, "")), photos({20.1}), kExact);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->photos[0]->sigma_assumed);
  EXPECT_TRUE(any_mentions(found->warnings, "states no sigma"));
}

TEST_F(GnssLogFile, MatchesTimeMarksByCountAndSpacingWhateverTheClock) {
  const GnssLog marks = log("flight.pos", pos_lines(kExposures));
  EXPECT_TRUE(marks.time_marks);
  std::vector<PhotoMoment> moments = photos(kExposures, std::nullopt);
  for (PhotoMoment& moment : moments) *moment.time.camera_clock += std::chrono::seconds(4321);
  const auto found = antenna_at_photos(marks, moments, std::nullopt);
  ASSERT_TRUE(found) << found.error().sentence;
  for (std::size_t i = 0; i < kExposures.size(); ++i) {
    ASSERT_TRUE(found->photos[i]);
    EXPECT_LT(error_m(*found->photos[i], kExposures[i]), 0.001);
    EXPECT_EQ(found->photos[i]->utc, at_s(kExposures[i]));
  }
}

TEST_F(GnssLogFile, RefusesTimeMarksThatFitInSeveralWays) {
  const GnssLog marks = log("flight_events.pos", pos_lines({5, 10, 15, 20, 25}));
  const auto found = antenna_at_photos(marks, photos({5, 10, 15, 20}), std::nullopt);
  ASSERT_FALSE(found);
  EXPECT_TRUE(mentions(found.error().sentence, "several ways"));
}

TEST_F(GnssLogFile, LetsTheTimeOffsetDecideWhereTimeMarksFitInSeveralWays) {
  const GnssLog marks = log("flight_events.pos", pos_lines({5, 10, 15, 20, 25}));
  const auto found = antenna_at_photos(marks, photos({10, 15, 20, 25}), TimeOffset{0, 0.1});
  ASSERT_TRUE(found) << found.error().sentence;
  EXPECT_LT(error_m(*found->photos[0], 10), 0.001);
}

TEST_F(GnssLogFile, RefusesTimeMarksWhoseIntervalsDisagree) {
  const GnssLog marks = log("flight_events.pos", pos_lines(kExposures));
  std::vector<double> other = kExposures;
  other[4] += 1.5;
  EXPECT_FALSE(antenna_at_photos(marks, photos(other), std::nullopt));
}

TEST_F(GnssLogFile, MatchesPhotosThatAreSortedByNameAndNotByTime) {
  std::vector<double> shuffled = kExposures;
  std::swap(shuffled[1], shuffled[6]);
  const GnssLog marks = log("flight_events.pos", pos_lines(kExposures));
  const auto found = antenna_at_photos(marks, photos(shuffled), std::nullopt);
  ASSERT_TRUE(found) << found.error().sentence;
  for (std::size_t i = 0; i < shuffled.size(); ++i) {
    EXPECT_LT(error_m(*found->photos[i], shuffled[i]), 0.001);
  }
}

TEST_F(GnssLogFile, SaysInOneSentenceWhatIsWrongWithAFile) {
  EXPECT_TRUE(mentions(read_gnss_log("/nowhere/a.nmea").error().sentence, "/nowhere/a.nmea"));
  EXPECT_TRUE(mentions(read_gnss_log(file("e.nmea", "")).error().sentence, "is empty"));
  EXPECT_TRUE(mentions(read_gnss_log(file("t.pos", "a poem\n")).error().sentence, "neither"));
  const auto nothing = read_gnss_log(file("n.nmea", sentence("GPGGA,,,,,,,,,,,,,,")));
  EXPECT_TRUE(mentions(nothing.error().sentence, "no position in any of them"));
  const auto flat = read_gnss_log(
      file("r.nmea", sentence("GPRMC,100001.00,A,3540.1,N,13945.7,E,3.0,90.0,201126,,,A")));
  EXPECT_TRUE(mentions(flat.error().sentence, "record GGA"));
}

TEST_F(GnssLogFile, CountsDamagedLines) {
  const GnssLog damaged = log("d.nmea", nmea_log(Date::kRmc) + "$GNGGA,1*00\r\n");
  EXPECT_TRUE(any_mentions(damaged.warnings, "1 of "));
}

TEST(TimeOffset, IsReadWithAndWithoutSigma) {
  EXPECT_EQ(parse_time_offset("-32400")->seconds, -32400);
  EXPECT_EQ(parse_time_offset("-32400")->sigma_s, 0.02);
  EXPECT_EQ(parse_time_offset("0.35,0.05")->sigma_s, 0.05);
  for (const char* bad : {"", "x", "1,", "1,-2", ",1", "nan", "1,2,3", "1e99"}) {
    const auto read = parse_time_offset(bad);
    ASSERT_FALSE(read) << bad;
    EXPECT_TRUE(mentions(read.error().sentence, "--time-offset"));
  }
}

// 40 flights of 20 photos: white and drifting receiver noise as stated, and a camera whose clock is
// off by the stated sigma in each flight.
TEST_F(GnssLogFile, StatesSigmasThatHold) {
  int count = 0;
  int one = 0;
  int two = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto noise3 = [&](double sigma_m) {
      return Eigen::Vector3d::NullaryExpr([&](Eigen::Index) { return sigma_m * normal(random); })
          .eval();
    };
    GnssLog noisy;
    Eigen::Vector3d drift_m = noise3(0.01);
    for (int i = 0; i <= 600; ++i) {
      const double t = i / 5.0;
      const geodesy::Geodetic place = foot().geodetic_of(climb(t) + drift_m + noise3(0.003));
      const Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() * (1e-4 + 9e-6);
      noisy.fixes.push_back({at_s(t),
                             {},
                             FixQuality::kFixed,
                             place.latitude_deg,
                             place.longitude_deg,
                             place.height_ellipsoidal_m,
                             {},
                             covariance,
                             {},
                             {}});
      const double keep = std::exp(-0.2 / 30);
      drift_m = keep * drift_m + std::sqrt(1 - keep * keep) * noise3(0.01);
    }
    const double clock_s = 0.05 * normal(random);
    std::vector<double> when;
    for (int i = 0; i < 20; ++i) when.push_back(2 + 5.77 * i);
    auto moments = photos(when);
    for (auto& moment : moments) {
      *moment.time.camera_clock += microseconds(std::llround(clock_s * 1e6));
    }
    const auto found = antenna_at_photos(noisy, moments, TimeOffset{0, 0.05});
    ASSERT_TRUE(found);
    for (std::size_t i = 0; i < when.size(); ++i) {
      const Eigen::Vector3d error_m = foot().enu_of(found->photos[i]->position) - climb(when[i]) -
                                      clock_s * found->photos[i]->velocity_enu_m_s.value();
      for (int axis = 0; axis < 3; ++axis) {
        const double ratio =
            std::abs(error_m[axis]) / std::sqrt(found->photos[i]->covariance_enu_m2(axis, axis));
        ++count;
        one += ratio <= 1;
        two += ratio <= 2;
      }
    }
  }
  std::cout << "within one sigma " << 1.0 * one / count << ", two " << 1.0 * two / count << " of "
            << count << "\n";
  EXPECT_GT(one, 0.60 * count);
  EXPECT_LT(one, 0.80 * count);
  EXPECT_GT(two, 0.90 * count);
}

}  // namespace
}  // namespace plumbline::ingest
