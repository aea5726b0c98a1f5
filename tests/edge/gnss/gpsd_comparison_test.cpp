// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "edge/gnss/nmea_parser.h"
#include "edge/gnss/time_text.h"
#include "tests/edge/gnss/nmea_text.h"
#include "tests/edge/gnss/real_logs.h"

namespace plumbline::gnss {
namespace {

struct Answers {
  std::map<std::string, nlohmann::json> by_time;  // "2020-03-18T13:28:19.600Z"
  std::vector<nlohmann::json> without_time;       // before the first RMC told the date
};

// gpsd's decoded positions. It reports an epoch again with every sentence that adds to it; the last
// report of a time is the whole of it.
Answers answers(const std::string& check) {
  Answers found;
  std::istringstream lines(check);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("{\"class\":\"TPV\"", 0) != 0) continue;
    const auto tpv = nlohmann::json::parse(line);
    if (!tpv.contains("lat") || !tpv.contains("lon")) continue;
    if (tpv.contains("time")) {
      found.by_time[tpv["time"]] = tpv;
    } else {
      found.without_time.push_back(tpv);
    }
  }
  return found;
}

// Within the last digit that gpsd prints.
bool is_place_of(const GnssFix& fix, const nlohmann::json& tpv) {
  return std::abs(*fix.latitude_deg - tpv["lat"].get<double>()) < 0.51e-9 &&
         std::abs(*fix.longitude_deg - tpv["lon"].get<double>()) < 0.51e-9;
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
  const auto [gpsd, without_time] = answers(contents(path.string() + ".chk"));
  const Parsed ours = parse(contents(path));
  EXPECT_EQ(ours.counters.bad_checksum + ours.counters.malformed, 0u);
  int compared = 0;
  for (const GnssFix& fix : ours.fixes) {
    ASSERT_TRUE(fix.time);
    const auto found = gpsd.find(with_milliseconds(text_of(*fix.time)));
    ASSERT_NE(found, gpsd.end()) << text_of(*fix.time);
    const auto& tpv = found->second;
    ++compared;
    EXPECT_TRUE(is_place_of(fix, tpv)) << found->first;
    EXPECT_NEAR(*fix.height_ellipsoidal_m, tpv["altHAE"].get<double>(), 0.51e-4) << found->first;
    EXPECT_NEAR(*fix.altitude_m, tpv["altMSL"].get<double>(), 0.51e-4) << found->first;
    EXPECT_EQ(fix.height_ellipsoidal_m ? 3 : 2, tpv["mode"].get<int>()) << found->first;
    if (tpv.contains("dgpsAge")) {
      EXPECT_NEAR(*fix.correction_age_s, tpv["dgpsAge"].get<double>(), 0.05);
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(compared), gpsd.size());
  for (const nlohmann::json& tpv : without_time) {
    EXPECT_TRUE(std::any_of(ours.fixes.begin(), ours.fixes.end(), [&](const GnssFix& fix) {
      return is_place_of(fix, tpv);
    })) << tpv;
  }
  std::cout << GetParam() << ": " << compared << " epochs compared, and " << without_time.size()
            << " of gpsd's reports that have no time yet\n";
}

constexpr std::array kChecked = {"nmea-rtk.log", "ublox-f9p-hpnmea.log", "ublox-zed-f9p-nmea.log",
                                 "nmea-fuzzy-cases.log"};

TEST(RealLogs, AreAllCompared) {
  if (!std::filesystem::exists(real_logs())) GTEST_SKIP() << "real receiver logs are not here";
  for (const auto& entry : std::filesystem::directory_iterator(real_logs())) {
    if (entry.path().extension() != ".chk") continue;
    const std::string log = entry.path().stem().string();
    EXPECT_NE(std::find(kChecked.begin(), kChecked.end(), log), kChecked.end()) << log;
  }
}

INSTANTIATE_TEST_SUITE_P(Gpsd, RealLog, testing::ValuesIn(kChecked), [](const auto& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
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
