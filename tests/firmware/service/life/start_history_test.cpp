// SPDX-License-Identifier: MIT
#include "firmware/service/life/start_history.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kBoot{0s};

// Each start is a program of its own: it has nothing but the file.
class StartedOften : public testing::Test {
 protected:
  StartHistory program(const std::string& boot = "boot-1") { return {folder_ / "starts", boot}; }
  int start_at(std::chrono::nanoseconds time, const std::string& boot = "boot-1") {
    return program(boot).begin(kBoot + time);
  }
  ingest::TemporaryFolder folder_;
};

TEST_F(StartedOften, CountsFailuresWithinAMinute) {
  EXPECT_EQ(start_at(100s), 0);
  EXPECT_EQ(start_at(110s), 1);
  EXPECT_EQ(start_at(120s), 2);
  EXPECT_EQ(start_at(130s), 3);
  EXPECT_EQ(start_at(159s), 4);
}

TEST_F(StartedOften, ForgetsThemAfterAMinute) {
  start_at(100s);
  start_at(110s);
  start_at(120s);
  EXPECT_EQ(start_at(175s), 1);  // that of 120 s
  EXPECT_EQ(start_at(300s), 0);
}

TEST_F(StartedOften, ForgetsThemWithAnEndInGoodOrder) {
  start_at(100s);
  start_at(101s);
  program().end_well();
  EXPECT_EQ(start_at(102s), 0);
}

// The clock of a new boot begins at nought.
TEST_F(StartedOften, DoesNotCountThoseOfAnotherBoot) {
  start_at(100s);
  start_at(101s);
  EXPECT_EQ(start_at(101s, "boot-2"), 0);
  EXPECT_EQ(start_at(102s, "boot-2"), 1);
}

TEST_F(StartedOften, DoesNotStumbleOverAFileOfRubbish) {
  std::ofstream(folder_ / "starts") << "boot-1 not-a-number\n\x01\x02 boot-1";
  EXPECT_EQ(start_at(100s), 0);
  EXPECT_EQ(start_at(101s), 1);
}

TEST_F(StartedOften, CountsNothingWhereTheFileCannotBeKept) {
  StartHistory nowhere(folder_ / "missing/starts", "boot-1");
  EXPECT_EQ(nowhere.begin(kBoot + 100s), 0);
  EXPECT_EQ(nowhere.begin(kBoot + 101s), 0);
}

}  // namespace
}  // namespace plumbline::service
