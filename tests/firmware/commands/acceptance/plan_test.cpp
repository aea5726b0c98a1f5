// SPDX-License-Identifier: MIT
// `plumbline plan` as a user runs it.
#include <gmock/gmock.h>

#include "tests/firmware/commands/acceptance/flight_folder.h"

namespace plumbline::acceptance {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class PlanCommand : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write_text(folder / "camera.toml",
               "width_px = 4000\nheight_px = 2250\nfocal_length_px = 2125.0\n"
               "[sigma]\nfocal_length_px = 0.5\nprincipal_point_px = [0.5, 0.5]\naffinity = 0\n"
               "skew = 0\nradial = [2e-4, 2e-4, 0]\ntangential = [2e-4, 2e-4]\n");
  }
  Outcome plan(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"plan", "--camera", "camera.toml"});
    return run_plumbline(arguments, folder);
  }
  Json plan_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const Outcome outcome = plan(std::move(arguments));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return Json::parse(outcome.out);
  }
  void expect_wrong(const std::vector<std::string>& arguments, const std::string& sentence) {
    const Outcome outcome = plan(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  }
};

const std::vector<std::string> kClimb = {"--from", "70", "--to", "90", "--step", "5"};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST_F(PlanCommand, GivesSigmasByRing) {
  const Json json =
      plan_json(kClimb + std::vector<std::string>{"--rtk", "0.005,0.010", "--side-step", "10"});
  EXPECT_EQ(json["photos"], 6);
  EXPECT_EQ(json["sigmas_are"], "absolute");
  double from_m = 0;
  for (const Json& ring : json["rings"]) {
    EXPECT_EQ(ring["from_m"], from_m);
    from_m = ring["to_m"];
    EXPECT_GT(ring["sigma_plan_m"], 0);
    EXPECT_GT(ring["sigma_height_m"], 0);
    EXPECT_GE(ring["sigma_height_absolute_m"], ring["sigma_height_local_m"]);
  }
  EXPECT_GT(json["azimuth_deg"], 0);
  EXPECT_LT(json["azimuth_deg"], 0.2);
  EXPECT_GT(json["standard_accuracy"]["sigma_height_m"], 0);
}

TEST_F(PlanCommand, SaysNullForWhatAStraightClimbCannotSee) {
  const Json json = plan_json(kClimb + std::vector<std::string>{"--rtk", "0.005,0.010"});
  EXPECT_TRUE(json["azimuth_deg"].is_null());
  EXPECT_TRUE(json["foot"]["sigma_height_m"].is_null());
  EXPECT_THAT(lines_of(json["unobservable"]),
              AllOf(HasSubstr("azimuth"), HasSubstr("height_at_foot")));
}

TEST_F(PlanCommand, HasLocalSigmasAloneWithoutRtk) {
  const Json json = plan_json(kClimb);
  EXPECT_EQ(json["sigmas_are"], "local");
  EXPECT_TRUE(json["rings"][0]["sigma_height_absolute_m"].is_null());
  EXPECT_EQ(json["rings"][0]["sigma_height_m"], json["rings"][0]["sigma_height_local_m"]);
}

TEST_F(PlanCommand, NamesTheCheapestChangeThatReachesTheGoal) {
  const std::vector<std::string> arguments =
      kClimb + std::vector<std::string>{"--rtk", "0.005,0.010", "--goal", "0.10"};
  const Json json = plan_json(arguments);
  EXPECT_EQ(json["goal_reached"], false);
  ASSERT_FALSE(json["cheapest"].is_null());
  EXPECT_LE(json["cheapest"]["sigma_plan_m"], 0.10);
  EXPECT_LE(json["cheapest"]["sigma_height_m"], 0.10);
  const std::string change = json["cheapest"]["change"];
  for (const Json& advice : json["advice"]) {
    if (advice["reaches_goal"]) {
      EXPECT_GE(advice["cost_s"], json["cheapest"]["cost_s"]);
    }
  }
  EXPECT_THAT(std::string(json["sentence"]), HasSubstr(change));
  EXPECT_THAT(plan(arguments).out, AllOf(HasSubstr("reaches the goal"), HasSubstr(change)));
}

TEST_F(PlanCommand, KnowsTheProfilesAndLetsOptionsStandForTheirParts) {
  EXPECT_EQ(plan_json({"--profile", "paper"})["photos"], 5);
  EXPECT_EQ(plan_json({"--profile", "standard"})["photos"], 14);
  EXPECT_EQ(plan_json({})["photos"], 14);
  EXPECT_EQ(plan_json({"--profile", "ice"})["photos"], 22);
  EXPECT_EQ(plan_json({"--profile", "standard", "--side-step", "0", "--from", "60"})["photos"], 7);
}

TEST_F(PlanCommand, EndsWithTwoAndOneSentenceOnWrongUsage) {
  expect_wrong({"--from", "90", "--to", "70"}, "ends below its start");
  expect_wrong({"--from", "80", "--to", "80"}, "one photo only");
  expect_wrong({"--from", "70"}, "both --from and --to");
  expect_wrong({"--profile", "other"}, "--profile");
  expect_wrong({"--from", "nan", "--to", "90"}, "'nan' is not a number from 1 to 10000");
  expect_wrong({"--rtk", "0.01"}, "--rtk");
  expect_wrong({"--goal", "0"}, "--goal");
  expect_wrong({"--goal", "nan"}, "--goal: 'nan' is not a number from 0.000001 to 1000");
  expect_wrong({"--known-length", "900"}, "too long");
}

TEST_F(PlanCommand, TakesFiniteNumbersOnly) {
  for (const char* option : {"--from",
                             "--to",
                             "--step",
                             "--side-step",
                             "--heading-sigma",
                             "--known-length",
                             "--length-sigma",
                             "--control-points",
                             "--control-sigma",
                             "--sigma-px",
                             "--ties",
                             "--radius",
                             "--tilt",
                             "--wander",
                             "--goal",
                             "--ceiling",
                             "--tilt-sigma",
                             "--max-azimuth-sigma",
                             "--max-tilt-sigma",
                             "--max-focal-length-sigma",
                             "--max-scale-sigma",
                             "--max-height-sigma",
                             "--max-position-sigma"}) {
    for (const char* number : {"nan", "inf", "-1", "1e400", "many"}) {
      expect_wrong({option, number}, std::string(option) + ": ");
    }
  }
  expect_wrong({"--rtk", "0.005,nan"}, "--rtk: 'nan'");
}

TEST_F(PlanCommand, EndsWithOneWhereTheCameraCannotBeRead) {
  expect_refused({"plan", "--camera", "none.toml"}, "Cannot read 'none.toml'");
}

}  // namespace
}  // namespace plumbline::acceptance
