// SPDX-License-Identifier: MIT
// plumbline status, of something that stands for the daemon.
#include "firmware/commands/status_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <thread>

#include "tests/firmware/commands/run_command.h"
#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::commands {
namespace {

// Says `text` to the first who asks, and goes.
class Speaker {
 public:
  Speaker(const std::string& path, std::string text)
      : listener_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    good_ = ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
            ::listen(listener_, 1) == 0;
    if (good_) thread_ = std::thread([this, said = std::move(text)] { speak(said); });
  }
  ~Speaker() {
    if (thread_.joinable()) thread_.join();
    ::close(listener_);
  }
  bool good() const { return good_; }

 private:
  void speak(const std::string& text) const {
    const int client = ::accept(listener_, nullptr, nullptr);
    (void)::send(client, text.data(), text.size(), MSG_NOSIGNAL);
    ::close(client);
  }

  int listener_;
  bool good_ = false;
  std::thread thread_;
};

CommandRun watch(std::vector<std::string> more) {
  const ingest::TemporaryFolder folder;
  const std::string socket = folder / "socket";
  const Speaker daemon(socket,
                       "{\"time\": \"1\", \"sentence\": \"Ready.\"}\n"
                       "{\"time\": \"2\", \"sentence\": \"Ready.\"}\n"
                       "{\"time\": \"3\", \"sentence\": \"Flying.\"}\n");
  EXPECT_TRUE(daemon.good());
  std::vector<std::string> arguments = {"status", "--socket", socket};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_command(add_status, arguments);
}

TEST(StatusCommand, SaysWhatTheDaemonIsDoing) {
  const CommandRun run = watch({});
  EXPECT_EQ(run.status, 0) << run.told;
  EXPECT_EQ(run.printed, "Ready.\n");
}

TEST(StatusCommand, WatchesForChangesOfTheSentence) {
  const CommandRun run = watch({"--watch"});
  EXPECT_EQ(run.printed, "Ready.\nFlying.\n");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.told, testing::HasSubstr("The daemon has stopped."));
}

TEST(StatusCommand, HandsOnEveryLineAsJson) {
  const CommandRun run = watch({"--watch", "--json"});
  EXPECT_THAT(run.printed, testing::HasSubstr("\"1\""));
  EXPECT_THAT(run.printed, testing::HasSubstr("\"2\""));
}

}  // namespace
}  // namespace plumbline::commands
