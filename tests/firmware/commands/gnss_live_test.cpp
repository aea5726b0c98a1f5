// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "sim/pty_port.h"
#include "tests/talk/receiver_talk.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// `plumbline gnss` as it runs beside a person, its output in files.
class LiveProgram {
 public:
  LiveProgram(const fs::path& folder, std::vector<std::string> arguments)
      : out_(folder / "out"), err_(folder / "err") {
    arguments.insert(arguments.begin(), {PLUMBLINE_PROGRAM, "gnss"});
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::dup2(::open(out_.c_str(), O_WRONLY | O_CREAT, 0644), STDOUT_FILENO);
    ::dup2(::open(err_.c_str(), O_WRONLY | O_CREAT, 0644), STDERR_FILENO);
    ::execv(PLUMBLINE_PROGRAM, words.data());
    ::_exit(127);
  }
  LiveProgram(const LiveProgram&) = delete;
  LiveProgram& operator=(const LiveProgram&) = delete;
  ~LiveProgram() {
    if (pid_ > 0) end(SIGKILL);
  }

  // Ends it as Ctrl-C does; its exit status.
  int interrupt() { return end(SIGINT); }

  std::string out() const { return contents(out_); }
  std::string err() const { return contents(err_); }

 private:
  int end(int signal) {
    ::kill(pid_, signal);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  fs::path out_;
  fs::path err_;
  pid_t pid_ = -1;
};

class GnssLive : public testing::Test {
 protected:
  GnssLive() : folder_(new_folder()), port_((folder_ / "ttyRTK").string()) {}
  ~GnssLive() override {
    port_.pull();
    fs::remove_all(folder_);
  }

  static fs::path new_folder() {
    std::string name = (fs::temp_directory_path() / "plumbline-live-XXXXXX").string();
    return ::mkdtemp(name.data());
  }

  // The receiver talks, ten times a second, until it holds.
  bool until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!holds() && std::chrono::steady_clock::now() < end) {
      port_.send(talk::positions(epoch_++));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return holds();
  }

  fs::path folder_;
  sim::PtyPort port_;
  int epoch_ = 0;
};

TEST_F(GnssLive, ShowsFixesAndStatesUntilItIsInterrupted) {
  ASSERT_TRUE(port_.plug_in());
  LiveProgram program(folder_, {port_.path()});
  ASSERT_TRUE(until([&] { return program.out().find("fixed") != std::string::npos; }));
  port_.pull();
  ASSERT_TRUE(until([&] { return program.err().find("has gone") != std::string::npos; }));
  const std::size_t before = program.out().size();
  ASSERT_TRUE(port_.plug_in());
  ASSERT_TRUE(until([&] { return program.out().size() > before; }));
  EXPECT_EQ(program.interrupt(), 0);
  EXPECT_THAT(program.out(), testing::StartsWith("time_utc"));
  EXPECT_THAT(program.out(), HasSubstr(" 90.263 fixed"));
  EXPECT_THAT(program.out(), testing::EndsWith("; 1 reconnections\n"));
  EXPECT_THAT(program.err(), HasSubstr("gives positions (fixed from 17 satellites)"));
}

TEST_F(GnssLive, GivesAnObjectPerFixAndTheCountersLast) {
  ASSERT_TRUE(port_.plug_in());
  LiveProgram program(folder_, {port_.path(), "--json", "--baud", "38400"});
  ASSERT_TRUE(until([&] { return program.out().find("lat_deg") != std::string::npos; }));
  EXPECT_EQ(program.interrupt(), 0);
  EXPECT_THAT(program.out(), testing::StartsWith("{\"time_utc\":"));
  EXPECT_THAT(program.out(), testing::EndsWith("\"reconnections\":0}\n"));
  EXPECT_THAT(program.err(), HasSubstr("at 38400 baud"));
}

TEST_F(GnssLive, TakesUpAPortThatIsNotThereYet) {
  LiveProgram program(folder_, {"/dev/ttyPLUMBLINE"});
  ASSERT_TRUE(until([&] { return program.err().find("There is no port") != std::string::npos; }));
  EXPECT_EQ(program.interrupt(), 0);
}

TEST_F(GnssLive, ListsThePortsWhereNoSourceIsNamed) {
  LiveProgram program(folder_, {});
  EXPECT_TRUE(until([&] { return !program.out().empty(); }));
  EXPECT_THAT(program.err(), testing::IsEmpty());
}

}  // namespace
}  // namespace plumbline::commands
