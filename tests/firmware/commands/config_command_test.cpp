// SPDX-License-Identifier: MIT
#include "firmware/commands/config_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/firmware/commands/run_command.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ConfigCommand : public testing::Test {
 protected:
  void SetUp() override {
    file = fs::temp_directory_path() /
           ("config_command_" + std::to_string(::getpid()) + "_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml");
  }
  void TearDown() override { fs::remove(file); }

  void write(const std::string& text) const { std::ofstream(file) << text; }

  // The status as the program would end; what it printed is kept.
  int run(std::vector<std::string> arguments) {
    const CommandRun command = run_command(add_config, std::move(arguments));
    printed = command.printed;
    told = command.told;
    return command.status;
  }

  fs::path file;
  std::string printed;
  std::string told;
};

TEST_F(ConfigCommand, AGoodFileIsToldToBeGoodAndWhatItAmountsTo) {
  write("[capture]\nfirst_m = 10\nlast_m = 20\nstep_m = 2.5\n");
  EXPECT_EQ(run({"config", "--check", file.string()}), 0);
  EXPECT_THAT(printed, testing::StartsWith(file.string() + ": good\n"));
  EXPECT_THAT(printed, HasSubstr("5 heights from 10 to 20 m"));
  EXPECT_EQ(told, "");
}

TEST_F(ConfigCommand, EveryFaultIsASentenceOnStandardError) {
  write("[receiver]\nadress = \"/dev/ttyS0\"\nlatency_s = 80\n");
  EXPECT_EQ(run({"config", "--check", file.string()}), 1);
  EXPECT_EQ(printed, "");
  EXPECT_EQ(std::ranges::count(told, '\n'), 2);
  EXPECT_THAT(told, HasSubstr(file.filename().string() + ":2: 'adress' is no key of [receiver]"));
}

TEST_F(ConfigCommand, JsonHoldsEveryKeyAndWhatIsWrong) {
  write("[advice]\ngoal_m = 0.02\n[camera]\ngain = 0\n");
  EXPECT_EQ(run({"config", "--check", file.string(), "--json"}), 1);
  const auto json = nlohmann::json::parse(printed);
  EXPECT_EQ(json["good"], false);
  EXPECT_EQ(json["errors"].size(), 1U);
  EXPECT_EQ(json["config"]["advice"]["goal_m"], 0.02);
  EXPECT_EQ(json["config"]["camera"]["gain"], "auto");
  EXPECT_EQ(json["heights_m"].size(), 13U);
}

TEST_F(ConfigCommand, ItsExampleIsGood) {
  ASSERT_EQ(run({"config", "--example"}), 0);
  write(printed);
  EXPECT_EQ(run({"config", "--check", file.string()}), 0);
}

TEST_F(ConfigCommand, AMissingFileAndWrongUsageAreToldApart) {
  EXPECT_EQ(run({"config", "--check", file.string()}), 1);
  EXPECT_THAT(told, HasSubstr("Cannot read"));
  EXPECT_EQ(run({"config"}), 2);
  EXPECT_EQ(run({"config", "--example", "--check", file.string()}), 2);
}

}  // namespace
}  // namespace plumbline::commands
