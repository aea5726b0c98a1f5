// SPDX-License-Identifier: MIT
#include "firmware/service/life/life_signs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/firmware/service/life/notify_socket.h"

namespace plumbline::service {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ShownLife : public testing::Test {
 protected:
  LifeSources sources() {
    return {[this] { return state_; }, [this] { return sentence_; },
            [this](record::Severity, const std::string& source, const std::string& sentence) {
              said_.push_back(source + ": " + sentence);
            }};
  }

  // Up, and whatever was said of it read.
  void be_ready() {
    state_.rounds = 1;
    look_.now();
    socket_.all();
  }

  ingest::TemporaryFolder folder_;
  NotifySocket socket_{folder_ / "notify"};
  ServiceManager manager_;
  Progress::State state_;
  std::string sentence_ = "Waiting.";
  std::vector<std::string> said_;
  LifeSigns::Look look_{manager_, sources()};
};

TEST_F(ShownLife, BeginsWithTheFirstRoundOfTheDecidingThread) {
  look_.now();
  EXPECT_THAT(socket_.all(), IsEmpty());
  state_.rounds = 1;
  look_.now();
  EXPECT_THAT(socket_.all(), ElementsAre("READY=1\nSTATUS=Waiting.", "WATCHDOG=1"));
}

TEST_F(ShownLife, GoesOnWithRoundsAndStopsWithoutThem) {
  be_ready();
  look_.now();
  EXPECT_THAT(socket_.all(), IsEmpty());
  state_.rounds = 5;
  look_.now();
  EXPECT_THAT(socket_.all(), ElementsAre("WATCHDOG=1"));
}

TEST_F(ShownLife, ShowsASentenceOnce) {
  be_ready();
  sentence_ = "Flying.";
  look_.now();
  look_.now();
  EXPECT_THAT(socket_.all(), ElementsAre("STATUS=Flying."));
}

TEST_F(ShownLife, StopsWhereSomethingHangsAndSaysSoOnce) {
  be_ready();
  state_.hangs = "The encoder hangs.";
  for (int k = 0; k < 3; ++k) {
    ++state_.rounds;
    look_.now();
  }
  EXPECT_THAT(socket_.all(), IsEmpty());
  EXPECT_THAT(said_, ElementsAre("program: The encoder hangs."));
  state_.hangs.clear();
  ++state_.rounds;
  look_.now();
  EXPECT_THAT(socket_.all(), ElementsAre("WATCHDOG=1"));
}

TEST_F(ShownLife, GoesOnWithADiskThatHangsAndSaysWhenItDoesNoMore) {
  be_ready();
  state_.disk_is_late = true;
  state_.rounds = 2;
  look_.now();
  state_.disk_is_late = false;
  state_.rounds = 3;
  look_.now();
  EXPECT_THAT(socket_.all(), ElementsAre("WATCHDOG=1", "WATCHDOG=1"));
  EXPECT_THAT(said_, ElementsAre(HasSubstr("not answered"), HasSubstr("answers again")));
}

TEST_F(ShownLife, SaysOnceThatTheManagerCannotBeTold) {
  ::setenv("NOTIFY_SOCKET", (folder_ / "another").c_str(), 1);
  for (int k = 0; k < 3; ++k) {
    ++state_.rounds;
    look_.now();
  }
  EXPECT_THAT(said_, ElementsAre(HasSubstr("cannot be told")));
}

TEST_F(ShownLife, IsLookedAtByAThreadOfItsOwn) {
  state_.rounds = 1;
  const LifeSigns signs(manager_, sources());
  EXPECT_TRUE(socket_.hears("WATCHDOG=1"));
}

}  // namespace
}  // namespace plumbline::service
