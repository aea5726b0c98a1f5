// SPDX-License-Identifier: MIT
// Distances, areas and volumes with their sigmas, as a user asks for them.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/firmware/commands/acceptance/flight_folder.h"
#include "tests/firmware/commands/acceptance/made_case.h"

namespace plumbline::acceptance {
namespace {

class Derived : public FolderTest {};

TEST_F(Derived, AreGivenWithSigmasThatHoldTheTruth) {
  const MadeCase made = write_case({.seed = 91}, folder / "case");
  const Outcome outcome = run_plumbline(
      {"orient", "case", "--distance", "P0,P1", "--area", "P0,P1,P2", "--volume", "P0,P1,P2@-5"},
      folder);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json derived = summary_of(folder / "case/result")["derived"];
  ASSERT_EQ(derived.size(), 3U);
  const Eigen::Vector3d a = made.points[0], b = made.points[1], c = made.points[2];
  const double area = 0.5 * std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
  const double volume = area * ((a.z() + b.z() + c.z()) / 3 + 5);
  const double truth[] = {(b - a).norm(), area, volume};
  const char* const units[] = {"m", "m2", "m3"};
  for (std::size_t i = 0; i < 3; ++i) {
    const double sigma = derived[i]["sigma"].get<double>();
    EXPECT_GT(sigma, 0);
    EXPECT_NEAR(derived[i]["value"].get<double>(), truth[i], 4 * sigma) << i;
    EXPECT_EQ(derived[i]["unit"], units[i]);
  }
  EXPECT_THAT(outcome.out, testing::HasSubstr("distance P0 P1"));
}

TEST_F(Derived, AreUnknownWithoutAScale) {
  write_case({.seed = 92, .stations = false}, folder / "case");
  ASSERT_EQ(run_plumbline({"orient", "case", "--distance", "P0,P1"}, folder).status, 0);
  EXPECT_TRUE(summary_of(folder / "case/result")["derived"][0]["value"].is_null());
}

TEST_F(Derived, AreRefusedWhereTheyCannotBeRead) {
  write_case({.seed = 93}, folder / "case");
  expect_refused({"orient", "case", "--distance", "P0,nowhere"}, "nowhere");
  expect_refused({"orient", "case", "--area", "P0,P1"}, "three points");
  expect_refused({"orient", "case", "--volume", "P0,P1,P2"}, "@LEVEL");
  expect_refused({"orient", "case", "--volume", "P0,P1,P2@nan"}, "@LEVEL");
  expect_refused({"orient", "case", "--volume", "P0,P1,P2@1e300"}, "more than 100 km");
  expect_refused({"orient", "case", "--area", "P0,P1,P0"}, "\"P0\" is named twice");
}

TEST_F(Derived, ADelayNeedsVelocities) {
  write_case({.seed = 94}, folder / "case");
  write_text(folder / "case/gnss.toml", "delay_s = 0.02\ndelay_sigma_s = 0.05\n");
  expect_refused({"orient", "case"}, "ve_m_s");
}

}  // namespace
}  // namespace plumbline::acceptance
