// SPDX-License-Identifier: MIT
#include "sim/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sim/flight.h"

namespace plumbline::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string sentence_of(const std::string& text) {
  const auto profile = parse_profile(text, "climb.toml");
  return profile.ok() ? "" : profile.error().sentence;
}

TEST(Profile, ExampleFileShowsTheDefaults) {
  std::ifstream file(std::string(PLUMBLINE_SIM_FOLDER) + "/profile_example.toml");
  std::stringstream text;
  text << file.rdbuf();
  const auto example = parse_profile(text.str(), "paper");
  ASSERT_TRUE(example.ok()) << example.error().sentence;
  const Flight from_file = fly(*example, 3);
  const Flight by_name = fly(*named_profile("paper"), 3);
  ASSERT_EQ(from_file.shots.size(), by_name.shots.size());
  for (std::size_t k = 0; k < from_file.shots.size(); ++k) {
    EXPECT_EQ(from_file.shots[k].pose.centre_m, by_name.shots[k].pose.centre_m);
    EXPECT_EQ(from_file.shots[k].gnss_in_enu_m, by_name.shots[k].gnss_in_enu_m);
    EXPECT_EQ(from_file.shots[k].time_s, by_name.shots[k].time_s);
  }
  EXPECT_EQ(from_file.calibrated_camera.interior, by_name.calibrated_camera.interior);
  EXPECT_EQ(example->jpeg_quality, by_name.profile.jpeg_quality);
  EXPECT_EQ(example->targets, by_name.profile.targets);
}

TEST(Profile, ExampleFileNamesEveryKey) {
  std::ifstream file(std::string(PLUMBLINE_SIM_FOLDER) + "/profile_example.toml");
  std::stringstream text;
  text << file.rdbuf();
  // Those that are left out there are shown behind a '#'.
  for (const char* key : {"# side_direction_deg = ", "# yaw_deg = ", "# target_diameter_m = "}) {
    EXPECT_THAT(text.str(), HasSubstr(key));
    const std::string line = std::string(key).substr(2) + "1.0";
    EXPECT_EQ(sentence_of(line), "") << line;
  }
}

TEST(Profile, ReadsWhatAFileChanges) {
  const auto profile = parse_profile(
      "gnss_white_sigma_m = [0.02, 0.03]\nfix = \"float\"\nside_step_m = [10, 0, 5]\n"
      "from_m = 40\nheading = true\nbase = \"standard\"\n",
      "climb.toml");
  ASSERT_TRUE(profile.ok()) << profile.error().sentence;
  EXPECT_EQ(profile->from_m, 40);
  EXPECT_EQ(profile->to_m, 90);
  EXPECT_EQ(profile->fix, Fix::kFloat);
  EXPECT_EQ(profile->gnss_error.white.vertical_m, 0.03);  // although `fix` stands after it
  EXPECT_GT(profile->gnss_error.offset.vertical_m, 0);
  EXPECT_THAT(profile->side_steps_m, ElementsAre(10, 5));
  EXPECT_TRUE(profile->heading);
}

TEST(Profile, NamesTheLineOfAKeyItDoesNotKnow) {
  EXPECT_THAT(sentence_of("from_m = 40\n\nhieght = 3\n"), StartsWith("climb.toml:3: 'hieght'"));
}

TEST(Profile, NamesTheLineOfAValueThatDoesNotFit) {
  EXPECT_THAT(sentence_of("from_m = 40\nto_m = \"high\"\n"),
              StartsWith("climb.toml:2: to_m wants a number from 5 to 1000"));
  EXPECT_THAT(sentence_of("from_m = nan\n"), StartsWith("climb.toml:1: from_m"));
  EXPECT_THAT(sentence_of("width_px = 640.5\n"), HasSubstr("whole number"));
  EXPECT_THAT(sentence_of("radial = [0.1, 0.2]\n"), HasSubstr("a list of 3 numbers"));
  EXPECT_THAT(sentence_of("gnss = 1\n"), HasSubstr("true or false"));
  EXPECT_THAT(sentence_of("fix = \"good\"\n"), HasSubstr("\"fixed\", \"float\" or \"single\""));
  EXPECT_THAT(sentence_of("base = \"moon\"\n"), HasSubstr("\"paper\""));
}

TEST(Profile, NamesTheLineOfBrokenToml) {
  EXPECT_THAT(sentence_of("from_m = 40\nto_m = = 3\n"), StartsWith("climb.toml:2: "));
}

TEST(Profile, RefusesAClimbThatEndsBelowItsStart) {
  EXPECT_THAT(sentence_of("from_m = 80\nto_m = 60\n"), HasSubstr("below its start"));
}

TEST(Profile, RefusesAClimbOfTooManyPhotos) {
  EXPECT_THAT(sentence_of("from_m = 10\nto_m = 1000\nstep_m = 0.1\n"), HasSubstr("step_m"));
}

}  // namespace
}  // namespace plumbline::sim
