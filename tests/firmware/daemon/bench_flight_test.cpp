// SPDX-License-Identifier: MIT
// One simulated flight in real time through the real daemon, its drivers, and a measuring process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/firmware/commands/acceptance/program.h"
#include "tests/firmware/daemon/benched_daemon.h"

namespace plumbline::acceptance {
namespace {

using ::testing::HasSubstr;

// In real time no flight is like the one before, whatever the seed: of 50,000 one may fall outside.
constexpr double kRare = 4.26;  // standard deviations

// The quantile of chi-square that lies where `normal` lies (Wilson and Hilferty 1931).
double chi_square(double freedoms, double normal) {
  const double part = 2 / (9 * freedoms);
  return freedoms * std::pow(1 - part + normal * std::sqrt(part), 3);
}

class FlightAtTheBench : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string pattern = (fs::temp_directory_path() / "plumbline-bench-XXXXXX").string();
    folder() = ::mkdtemp(pattern.data());
    BenchedDaemon daemon(folder());
    status() = daemon.wait_for_result(300);
    exit_status() = daemon.stop();
    log() = daemon.log();
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }

  static fs::path& folder() {
    static fs::path path;
    return path;
  }
  static Json& status() {
    static Json json;
    return json;
  }
  static int& exit_status() {
    static int status = -1;
    return status;
  }
  static std::string& log() {
    static std::string text;
    return text;
  }
  static fs::path flight() { return folder() / "bench/flights/0001"; }
};

// All in one: the flight takes two minutes.
TEST_F(FlightAtTheBench, IsRecordedWholeReplayedBitForBitAndMeasuredAsTheTruthWas) {
  EXPECT_EQ(exit_status(), 0) << log();
  EXPECT_EQ(status().value("photos_missed", -1), 0) << log();
  EXPECT_THAT(status().value("result", ""), HasSubstr("0001/result/report.html")) << log();

  // Whole: each height of the plan once.
  const Outcome check = run_plumbline({"check", flight().string(), "--dump"}, folder());
  EXPECT_EQ(check.status, 0) << check.err;
  for (int step = 30; step <= 90; step += 5) {
    const std::string taken = "for=height step_m=" + std::to_string(step) + ".00 ";
    const std::size_t first = check.out.find(taken);
    ASSERT_NE(first, std::string::npos) << step;
    EXPECT_EQ(check.out.find(taken, first + 1), std::string::npos) << step;
  }
  EXPECT_TRUE(fs::exists(flight() / "camera.toml"));

  // Replayed.
  const Outcome replay = run_plumbline({"replay", flight().string(), "--json"}, folder());
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;

  // Measured while it flew, and again with the targets: as the truth was.
  EXPECT_TRUE(summary_of(flight() / "result").value("converged", false));
  const Outcome measured = run_plumbline(
      {"measure", flight().string(), "--picks", (flight() / "truth/picks.csv").string(), "--check",
       (flight() / "truth/check.csv").string(), "--out", (folder() / "checked").string()},
      folder());
  ASSERT_EQ(measured.status, 0) << measured.err;
  const Json truth = summary_of(folder() / "checked")["check"];
  EXPECT_EQ(truth["points"], 39);
  const double nees = truth["joint_nees"], freedoms = truth["joint_nees_dof"];
  EXPECT_GE(nees, chi_square(freedoms, -kRare)) << measured.out;
  EXPECT_LE(nees, chi_square(freedoms, kRare)) << measured.out;
  EXPECT_GE(truth["share_within_two_sigma"], 0.9) << measured.out;
}

}  // namespace
}  // namespace plumbline::acceptance
