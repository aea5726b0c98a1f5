// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "edge/gnss/nmea_parser.h"
#include "edge/gnss/time_text.h"
#include "tests/edge/gnss/nmea_text.h"

namespace plumbline::gnss {
namespace {

std::filesystem::path real_logs() {
  const char* shared = std::getenv("PLUMBLINE_SHARED");
  const std::filesystem::path beside =
      std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared";
  return (shared != nullptr ? std::filesystem::path(shared) : beside) / "data" / "nmea";
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// gpsd's decoded answers by time, "2020-03-18T13:28:19.600Z". It reports an epoch again with every
// sentence that adds to it; the last report of a time is the whole of it.
std::map<std::string, nlohmann::json> answers(const std::string& check, int& without_time) {
  std::map<std::string, nlohmann::json> by_time;
  std::istringstream lines(check);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("{\"class\":\"TPV\"", 0) != 0) continue;
    const auto tpv = nlohmann::json::parse(line);
    if (!tpv.contains("lat")) continue;
    if (tpv.contains("time")) {
      by_time[tpv["time"]] = tpv;
    } else {
      ++without_time;  // before the first RMC told the date
    }
  }
  return by_time;
}

std::string with_milliseconds(std::string text) {
  text.back() = '0';  // ours ends at hundredths
  return text.append("Z");
}

class RealLog : public testing::TestWithParam<const char*> {};

TEST_P(RealLog, IsReadAsGpsdReadsIt) {
  const auto path = real_logs() / GetParam();
  if (!std::filesystem::exists(path)) {
    std::cout << "no " << path << ": real receiver logs are not part of the repository\n";
    GTEST_SKIP() << "real receiver logs are not here";
  }
  int without_time = 0;
  const auto gpsd = answers(contents(path.string() + ".chk"), without_time);
  const Parsed ours = parse(contents(path));
  EXPECT_EQ(ours.counters.bad_checksum + ours.counters.malformed, 0u);
  int compared = 0;
  for (const GnssFix& fix : ours.fixes) {
    ASSERT_TRUE(fix.time);
    const auto found = gpsd.find(with_milliseconds(text_of(*fix.time)));
    ASSERT_NE(found, gpsd.end()) << text_of(*fix.time);
    const auto& tpv = found->second;
    ++compared;
    EXPECT_NEAR(*fix.latitude_deg, tpv["lat"].get<double>(), 0.51e-9) << found->first;
    EXPECT_NEAR(*fix.longitude_deg, tpv["lon"].get<double>(), 0.51e-9) << found->first;
    EXPECT_NEAR(*fix.height_ellipsoidal_m, tpv["altHAE"].get<double>(), 0.51e-4) << found->first;
    EXPECT_NEAR(*fix.altitude_m, tpv["altMSL"].get<double>(), 0.51e-4) << found->first;
    EXPECT_EQ(fix.height_ellipsoidal_m ? 3 : 2, tpv["mode"].get<int>()) << found->first;
    if (tpv.contains("dgpsAge")) {
      EXPECT_NEAR(*fix.correction_age_s, tpv["dgpsAge"].get<double>(), 0.05);
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(compared), gpsd.size());
  std::cout << GetParam() << ": " << compared << " epochs compared, " << without_time
            << " of gpsd's reports have no time yet\n";
}

INSTANTIATE_TEST_SUITE_P(Gpsd, RealLog,
                         testing::Values("nmea-rtk.log", "ublox-f9p-hpnmea.log",
                                         "ublox-zed-f9p-nmea.log", "nmea-fuzzy-cases.log"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

TEST(RealReach, SentencesAreAllRead) {
  const auto path = real_logs() / "emlid_snippets.nmea";
  if (!std::filesystem::exists(path)) {
    std::cout << "no " << path << ": real receiver logs are not part of the repository\n";
    GTEST_SKIP() << "real receiver logs are not here";
  }
  const Parsed ours = parse(contents(path));
  EXPECT_EQ(ours.counters.bad_checksum + ours.counters.malformed, 0u);
  EXPECT_EQ(ours.counters.sentences, 29u);
  ASSERT_EQ(ours.fixes.size(), 2u);
  EXPECT_EQ(text_of(*ours.fixes[1].time), "2023-08-30T23:19:38.60Z");
  EXPECT_NEAR(*ours.fixes[1].height_ellipsoidal_m, 52.140 + 51.454, 1e-9);
  EXPECT_NEAR((*ours.fixes[1].covariance_enu_m2)(0, 0), 6.4 * 6.4, 1e-9);
}

}  // namespace
}  // namespace plumbline::gnss
