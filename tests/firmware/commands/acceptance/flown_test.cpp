// SPDX-License-Identifier: MIT
// A simulated flight of the daemon: recorded, decided again, measured.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "tests/firmware/commands/acceptance/program.h"

namespace plumbline::acceptance {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// The quantile of chi-square that lies where `normal` lies (Wilson and Hilferty 1931).
double quantile(double freedoms, double normal) {
  const double part = 2 / (9 * freedoms);
  return freedoms * std::pow(1 - part + normal * std::sqrt(part), 3);
}

class FlownFlight : public testing::Test {
 protected:
  FlownFlight() {
    std::string pattern = (fs::temp_directory_path() / "plumbline-flown-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~FlownFlight() override { fs::remove_all(folder_); }

  Json json_of(const std::string& command) {
    const Outcome outcome = run_plumbline({command, "flown", "--json"}, folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  // Five heights, and two photos of the side-step. The receiver's latency is off by 30 ms at 2 m/s,
  // 1 sigma, and gusts come between aim and release.
  void expect_photos_at_the_heights_of_the_plan() {
    const auto photos = rows_of(folder_ / "flown/truth/photos.csv");
    ASSERT_EQ(photos.size(), 7u);
    double height_m = 70;
    for (std::size_t k = 0; k < 5; ++k, height_m += 5) {
      EXPECT_NEAR(std::strtod(photos[k].at("u_m").c_str(), nullptr), height_m, 0.35) << k;
    }
    for (const auto& photo : photos) {
      EXPECT_TRUE(fs::exists(folder_ / "flown/photos" / photo.at("photo")));
    }
  }

  fs::path folder_;
};

// All in one: it takes a while to paint.
TEST_F(FlownFlight, IsRecordedWholeDecidedAgainBitForBitAndMeasuredAsItsTruthWas) {
  const Outcome simulated = run_plumbline(
      {"sim", "flown", "--fly", "--seed", "7", "--profile", PLUMBLINE_SMALL_FLIGHT}, folder_);
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  EXPECT_THAT(simulated.out, StartsWith("7 photos of 16 targets in flown\n"));
  EXPECT_THAT(simulated.out, HasSubstr("\ndecide again: plumbline replay flown\n"));
  expect_photos_at_the_heights_of_the_plan();

  const Json check = json_of("check");
  EXPECT_EQ(check["state"], "complete");
  EXPECT_EQ(check["photos_stored"], 7);
  EXPECT_EQ(check["photos_missed"], 0);
  const Json replay = json_of("replay");
  EXPECT_EQ(replay["decisions"], replay["as_flown"]);
  EXPECT_GE(replay["decisions"], 7);

  // Its photos say nothing of positions: the recording does.
  const Outcome measured = run_plumbline({"measure", "flown", "--picks", "flown/truth/picks.csv",
                                          "--check", "flown/truth/check.csv", "--out", "result"},
                                         folder_);
  ASSERT_EQ(measured.status, 0) << measured.err;
  const Json summary = summary_of(folder_ / "result");
  EXPECT_EQ(summary["photos_used"], 7);
  const Json truth = summary["check"];
  EXPECT_EQ(truth["points"], 16);
  const double nees = truth["joint_nees"], freedoms = truth["joint_nees_dof"];
  EXPECT_GE(nees, quantile(freedoms, -3.3)) << measured.out;
  EXPECT_LE(nees, quantile(freedoms, 3.3)) << measured.out;
}

}  // namespace
}  // namespace plumbline::acceptance
