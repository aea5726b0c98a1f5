// SPDX-License-Identifier: MIT
#include "firmware/commands/sim_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/firmware/commands/run_command.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class SimCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder =
        fs::temp_directory_path() / ("sim_command_" + std::to_string(::getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder);
    std::ofstream(folder / "small.toml")
        << "from_m = 12\nto_m = 14\nstep_m = 2\nwidth_px = 320\nheight_px = 240\n"
           "focal_length_px = 260\ntargets = 5\n";
  }
  void TearDown() override { fs::remove_all(folder); }

  // The status as the program would end; what went to stderr is kept.
  int run(std::vector<std::string> arguments) {
    const CommandRun command = run_command(add_sim, std::move(arguments));
    told = command.told;
    return command.status;
  }
  int run_small(const fs::path& out, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"sim", out.string(), "--profile",
                                       (folder / "small.toml").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  fs::path folder;
  std::string told;
};

TEST_F(SimCommand, WritesPhotosCameraAndTruth) {
  ASSERT_EQ(run_small(folder / "out", {"--side-step", "2"}), 0) << told;
  for (const char* name :
       {"photos/0001.jpg", "photos/0002.jpg", "photos/0003.jpg", "camera.toml", "truth/camera.toml",
        "truth/photos.csv", "truth/picks.csv", "truth/check.csv", "truth/surface.asc"}) {
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder / "out/photos/0004.jpg"));
}

TEST_F(SimCommand, GivesTheSameBytesForTheSameSeedWithOneThreadOrTwo) {
  ASSERT_EQ(run_small(folder / "a", {"--seed", "9", "--threads", "1"}), 0);
  ASSERT_EQ(run_small(folder / "b", {"--seed", "9", "--threads", "2"}), 0);
  ASSERT_EQ(run_small(folder / "c", {"--seed", "10"}), 0);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "a")) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), folder / "a");
    EXPECT_EQ(text_of(entry.path()), text_of(folder / "b" / name)) << name;
    ++files;
    if (name == "truth/camera.toml") continue;  // the same lens on every flight
    EXPECT_NE(text_of(entry.path()), text_of(folder / "c" / name)) << name;
  }
  EXPECT_EQ(files, 8);
}

TEST_F(SimCommand, FliesTheSameBytesForTheSameSeedWithOneThreadOrTwo) {
  ASSERT_EQ(run_small(folder / "a", {"--fly", "--seed", "9", "--threads", "1"}), 0) << told;
  ASSERT_EQ(run_small(folder / "b", {"--fly", "--seed", "9", "--threads", "2"}), 0) << told;
  ASSERT_EQ(run_small(folder / "c", {"--fly", "--seed", "10"}), 0) << told;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "a")) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), folder / "a");
    EXPECT_EQ(text_of(entry.path()), text_of(folder / "b" / name)) << name;
    ++files;
  }
  EXPECT_EQ(files, 9);  // two photos, camera and truth, and the journal
  EXPECT_NE(text_of(folder / "a/flight.journal"), text_of(folder / "c/flight.journal"));
}

TEST_F(SimCommand, WritesNoRecordingWhereItDoesNotFly) {
  ASSERT_EQ(run_small(folder / "out"), 0) << told;
  EXPECT_FALSE(fs::exists(folder / "out/flight.journal"));
}

TEST_F(SimCommand, RefusesToFlyWhatADaemonCannot) {
  EXPECT_EQ(run_small(folder / "out", {"--fly", "--no-gnss"}), 2);
  EXPECT_EQ(run_small(folder / "out", {"--fly", "--heading"}), 2);
  EXPECT_EQ(run_small(folder / "out", {"--fly", "--side-direction", "10"}), 2);
  EXPECT_EQ(run_small(folder / "out", {"--fly", "--fix", "float"}), 1);
  EXPECT_THAT(told, HasSubstr("the receiver has a fixed solution"));
  EXPECT_EQ(run_small(folder / "out", {"--fly", "--side-step", "2,2"}), 1);
  EXPECT_THAT(told, HasSubstr("goes aside once"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(SimCommand, DoesNotTouchAFolderThatHoldsFiles) {
  fs::create_directories(folder / "mine");
  std::ofstream(folder / "mine/notes.txt") << "keep";
  EXPECT_EQ(run_small(folder / "mine"), 1);
  EXPECT_THAT(told, HasSubstr("holds files already"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "mine"), {}), 1);
}

TEST_F(SimCommand, SaysWhereAProfileIsWrong) {
  std::ofstream(folder / "small.toml") << "from_m = 12\nheigth = 3\n";
  EXPECT_EQ(run_small(folder / "out"), 1);
  EXPECT_THAT(told, HasSubstr("small.toml:2: 'heigth' is no key"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(SimCommand, RefusesAProfileThatIsNeitherNameNorFile) {
  EXPECT_EQ(run({"sim", (folder / "out").string(), "--profile", "moon"}), 1);
  EXPECT_THAT(told, HasSubstr("'moon' is neither a profile"));
}

TEST_F(SimCommand, RefusesAGroundPhotoThatIsNone) {
  std::ofstream(folder / "ground.jpg") << "no picture at all";
  EXPECT_EQ(run_small(folder / "out", {"--texture", (folder / "ground.jpg").string()}), 1);
  EXPECT_THAT(told, HasSubstr("ground.jpg"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(SimCommand, CallsWrongOptionsWrongUsage) {
  EXPECT_EQ(run_small(folder / "out", {"--fix", "good"}), 2);
  EXPECT_EQ(run_small(folder / "out", {"--rtk", "0.005"}), 2);
  EXPECT_EQ(run({"sim"}), 2);
}

TEST_F(SimCommand, TakesListsOfFiguresWithTheFolderBehindThem) {
  EXPECT_EQ(run({"sim", "--profile", (folder / "small.toml").string(), "--rtk", "0.01,0.02",
                 "--side-step", "2,1", (folder / "out").string()}),
            0)
      << told;
  EXPECT_TRUE(fs::exists(folder / "out/photos/0004.jpg"));
}

TEST_F(SimCommand, ExplainsItselfWithAnExample) { EXPECT_EQ(run({"sim", "--help"}), 0); }

}  // namespace
}  // namespace plumbline::commands
