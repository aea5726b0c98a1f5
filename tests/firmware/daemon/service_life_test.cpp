// SPDX-License-Identifier: MIT
// plumblined as a service manager sees it, without receiver and camera.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/firmware/commands/acceptance/program.h"
#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/firmware/service/notify_socket.h"

namespace plumbline::acceptance {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kReduced = "without advice and measuring";

class DaemonAsAService : public testing::Test {
 protected:
  DaemonAsAService() {
    fs::create_directory(folder_ / "flights");
    std::ofstream(config_) << "[receiver]\naddress = \"" << (folder_ / "no-receiver").string()
                           << "\"\n[camera]\nid = \"/dev/video99\"\n[recording]\nfolder = \""
                           << (folder_ / "flights").string() << "\"\n[status]\nfile = \""
                           << (folder_ / "status.json").string() << "\"\nsocket = \""
                           << (folder_ / "socket").string() << "\"\n";
  }
  ~DaemonAsAService() override {
    if (process_ > 0) end(SIGKILL);
  }

  void start() {
    process_ = ::fork();
    if (process_ != 0) return;
    ::execl(PLUMBLINE_DAEMON, PLUMBLINE_DAEMON, "--config", config_.c_str(), nullptr);
    ::_exit(127);
  }
  int end(int signal) {
    ::kill(process_, signal);
    int status = -1;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return status;
  }
  // What it says first, once it is up.
  std::string ready() { return manager_.next(20'000).value_or("nothing"); }
  // Whether the status file says so within ten seconds.
  bool is_shown(const std::string& part) const {
    for (int k = 0; k < 100; ++k) {
      const Json status = Json::parse(text_of(folder_ / "status.json"), nullptr, false);
      const std::string sentence = status.is_object() ? status.value("sentence", "") : "";
      if (sentence.find(part) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }
  void fail_times(int times) {
    for (int k = 0; k < times; ++k) {
      start();
      ASSERT_TRUE(manager_.hears("READY=1"));
      end(SIGKILL);
      manager_.all();  // what it said last
    }
  }

  ingest::TemporaryFolder folder_;
  fs::path config_ = folder_ / "plumbline.toml";
  service::NotifySocket manager_{folder_ / "notify"};
  pid_t process_ = -1;
};

TEST_F(DaemonAsAService, IsReadyAndLivesWithoutAnyDeviceAndSaysThatItStops) {
  start();
  EXPECT_THAT(ready(), HasSubstr("READY=1\nSTATUS=Waiting for a position"));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(manager_.hears("WATCHDOG=1"));
  ::kill(process_, SIGTERM);
  EXPECT_TRUE(manager_.hears("STOPPING=1"));
  EXPECT_EQ(end(SIGTERM), 0);
}

TEST_F(DaemonAsAService, ShowsNoLifeWhereItsProcessStandsStill) {
  start();
  ASSERT_TRUE(manager_.hears("WATCHDOG=1"));
  ::kill(process_, SIGSTOP);
  ::waitpid(process_, nullptr, WUNTRACED);
  manager_.all();
  EXPECT_FALSE(manager_.next(3000));
  ::kill(process_, SIGCONT);
  EXPECT_TRUE(manager_.hears("WATCHDOG=1"));
}

TEST_F(DaemonAsAService, IsWholeAfterTwoFailures) {
  fail_times(2);
  start();
  EXPECT_THAT(ready(), AllOf(HasSubstr("READY=1"), Not(HasSubstr(kReduced))));
}

TEST_F(DaemonAsAService, IsReducedAfterThreeFailuresUntilItIsStopped) {
  fail_times(3);
  start();
  EXPECT_THAT(ready(), AllOf(HasSubstr("READY=1"), HasSubstr(kReduced)));
  EXPECT_TRUE(is_shown(kReduced));
  EXPECT_EQ(end(SIGTERM), 0);
  manager_.all();
  start();
  EXPECT_THAT(ready(), AllOf(HasSubstr("READY=1"), Not(HasSubstr(kReduced))));
}

TEST_F(DaemonAsAService, KeepsInTheRecordingOfAFlightThatItIsReduced) {
  fail_times(3);
  start();
  ASSERT_TRUE(manager_.hears("READY=1"));
  EXPECT_EQ(end(SIGTERM), 0);
  std::string journals;
  for (const auto& file : fs::recursive_directory_iterator(folder_ / "flights")) {
    if (file.path().filename() == "flight.journal") journals += text_of(file.path());
  }
  EXPECT_THAT(journals, HasSubstr(kReduced));
}

}  // namespace
}  // namespace plumbline::acceptance
