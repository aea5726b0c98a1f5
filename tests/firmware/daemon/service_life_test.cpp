// SPDX-License-Identifier: MIT
// plumblined as a service manager sees it, without receiver and camera.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "tests/firmware/commands/acceptance/program.h"
#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/firmware/service/life/notify_socket.h"

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

  void start(std::optional<rlim_t> memory_bytes = {}) {
    process_ = ::fork();
    if (process_ != 0) return;
    const rlimit most{memory_bytes.value_or(RLIM_INFINITY), RLIM_INFINITY};
    ::setrlimit(RLIMIT_AS, &most);
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
  // Its status, where it ends before it gives a sign of life.
  std::optional<int> end_before_it_lives() {
    for (;;) {
      const auto message = manager_.next(50);
      if (message && message->find("WATCHDOG=1") != std::string::npos) return std::nullopt;
      int status = -1;
      if (::waitpid(process_, &status, WNOHANG) == 0) continue;
      process_ = -1;
      return status;
    }
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

TEST_F(DaemonAsAService, RefusesABrokenConfigurationAndTouchesNothing) {
  std::ofstream(config_, std::ios::app) << "[reciever]\nx = 1\n[capture]\nstep_m = -5\n";
  const Outcome refused = run_any({PLUMBLINE_DAEMON, "--config", config_.string()}, folder_ / "");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("plumbline.toml:10"), HasSubstr("receiver"),
                                 HasSubstr("plumbline.toml:13"), HasSubstr("step_m")));
  EXPECT_TRUE(fs::is_empty(folder_ / "flights"));
  EXPECT_FALSE(fs::exists(folder_ / "status.json"));
  EXPECT_FALSE(manager_.next(0)) << "it is not ready";
}

// Memory that is too little for some or all of its threads: a sentence, or a life.
TEST_F(DaemonAsAService, EndsInOrderWhereMemoryEnds) {
  for (rlim_t megabytes = 20; megabytes <= 140; megabytes += 10) {
    start(megabytes << 20);
    const std::optional<int> ended = end_before_it_lives();
    const int status = ended ? *ended : end(SIGTERM);
    ASSERT_TRUE(WIFEXITED(status)) << megabytes << " MiB: signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), ended ? 1 : 0) << megabytes;
    manager_.all();
  }
}

}  // namespace
}  // namespace plumbline::acceptance
