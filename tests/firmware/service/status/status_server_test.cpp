// SPDX-License-Identifier: MIT
#include "firmware/service/status/status_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

// Who asks: reads lines, for at most five seconds each.
class Client {
 public:
  explicit Client(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    const timeval patience{5, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    good_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool good() const { return good_; }
  nlohmann::json next() {
    std::string line;
    for (char byte = 0; ::recv(socket_, &byte, 1, 0) == 1 && byte != '\n';) line += byte;
    return nlohmann::json::parse(line, nullptr, false);
  }
  void say(const std::string& bytes) {
    (void)::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

 private:
  int socket_;
  bool good_ = false;
};

class StatusShown : public testing::Test {
 protected:
  void SetUp() override {
    auto server = StatusServer::start(board_, socket_, file_);
    ASSERT_TRUE(server) << server.error().sentence;
    server_ = std::move(*server);
  }
  // The first line for which `holds`; of five seconds without a line none.
  static nlohmann::json next_where(Client& client,
                                   const std::function<bool(const nlohmann::json&)>& holds) {
    nlohmann::json line = client.next();
    while (line.is_object() && !holds(line)) line = client.next();
    return line;
  }
  nlohmann::json in_file() const {
    return nlohmann::json::parse(std::ifstream(file_), nullptr, false);
  }

  ingest::TemporaryFolder folder_;
  std::string socket_ = (folder_.path() / "socket").string();
  std::string file_ = (folder_.path() / "status.json").string();
  StatusBoard board_;
  std::unique_ptr<StatusServer> server_;
};

TEST_F(StatusShown, IsALineAtOnceAndOneAfterEachChange) {
  Client client(socket_);
  ASSERT_TRUE(client.good());
  EXPECT_EQ(client.next()["photos_stored"], 0);
  board_.stored(1, "0001");
  nlohmann::json line = client.next();
  while (line.is_object() && line["photos_stored"] != 1) line = client.next();
  ASSERT_TRUE(line.is_object());
  EXPECT_EQ(line["flight"], "0001");
  const nlohmann::json file = in_file();
  ASSERT_TRUE(file.is_object());
  EXPECT_EQ(file["photos_stored"], 1);
}

TEST_F(StatusShown, GoesOnWithWhatChangesBetweenPhotos) {
  Client client(socket_);
  capture::FixHeard heard;
  heard.fix.quality = FixQuality::kFixed;
  heard.fix.height_ellipsoidal_m = 100;
  board_.decided({HostTime{}, capture::PhaseChanged{capture::Phase::kFlying, 100.0}});
  board_.heard({HostTime{}, heard});
  const auto height_is = [](double height_m) {
    return [=](const nlohmann::json& line) {
      return line.value("height_above_take_off_m", -1.0) == height_m;
    };
  };
  ASSERT_TRUE(next_where(client, height_is(0)).is_object());
  heard.fix.height_ellipsoidal_m = 142;
  board_.heard({HostTime{}, heard});
  EXPECT_TRUE(next_where(client, height_is(42)).is_object());
  EXPECT_EQ(in_file()["height_above_take_off_m"], 42);
}

TEST_F(StatusShown, TellsByItsTimeThatTheDaemonLives) {
  Client client(socket_);
  const nlohmann::json first = client.next();
  ASSERT_EQ(first["pid"], ::getpid());
  const auto later = [&](const nlohmann::json& line) { return line["time"] > first["time"]; };
  const nlohmann::json line = next_where(client, later);
  EXPECT_TRUE(line.is_object());
  EXPECT_GE(in_file()["time"], line["time"]);
}

TEST_F(StatusShown, SaysAtTheEndThatItIsTheEnd) {
  board_.decided({HostTime{}, capture::PhaseChanged{capture::Phase::kFlying, 100.0}});
  Client client(socket_);
  EXPECT_EQ(client.next()["phase"], "flying");
  board_.stopped();
  server_.reset();
  const auto is_stopped = [](const nlohmann::json& line) { return line["phase"] == "stopped"; };
  EXPECT_TRUE(next_where(client, is_stopped).is_object());
  EXPECT_EQ(in_file()["phase"], "stopped");
}

TEST_F(StatusShown, RefusesAFileThatCannotBeWritten) {
  const std::string nowhere = (folder_.path() / "no/status.json").string();
  const std::string other = (folder_.path() / "other").string();
  const auto server = StatusServer::start(board_, other, nowhere);
  ASSERT_FALSE(server);
  EXPECT_THAT(server.error().sentence, HasSubstr("status file " + nowhere));
  EXPECT_THAT(server.error().sentence, HasSubstr("No such file or directory"));
  EXPECT_THAT(server.error().sentence, HasSubstr("is its folder there"));
  EXPECT_FALSE(std::filesystem::exists(other));
}

// Its folder is taken away and put back: that stands for a full disk, and works as root too.
TEST_F(StatusShown, TellsOnceThatTheFileCannotBeWrittenAnyLonger) {
  const auto place = folder_ / "place";
  std::filesystem::create_directory(place);
  std::mutex mutex;
  std::vector<std::string> told;
  const auto count = [&] {
    const std::lock_guard lock(mutex);
    return told.size();
  };
  auto server = StatusServer::start(board_, "", place / "status.json",
                                    [&](bool good, const std::string& sentence) {
                                      const std::lock_guard lock(mutex);
                                      told.push_back((good ? "good: " : "bad: ") + sentence);
                                    });
  ASSERT_TRUE(server) << server.error().sentence;
  std::filesystem::remove_all(place);
  for (int k = 0; k < 100 && count() < 1; ++k) std::this_thread::sleep_for(50ms);
  std::this_thread::sleep_for(2500ms);
  ASSERT_EQ(count(), 1u);
  EXPECT_THAT(told[0], HasSubstr("bad: Cannot write the status file"));
  std::filesystem::create_directory(place);
  for (int k = 0; k < 100 && count() < 2; ++k) std::this_thread::sleep_for(50ms);
  server->reset();
  ASSERT_EQ(told.size(), 2u);
  EXPECT_THAT(told[1], HasSubstr("good: "));
}

TEST_F(StatusShown, IsTheSameForManyWhateverOneOfThemSays) {
  Client rude(socket_);
  rude.say(std::string(100000, '\xff'));
  { const Client gone(socket_); }
  Client polite(socket_);
  EXPECT_TRUE(rude.next().is_object());
  EXPECT_TRUE(polite.next().is_object());
  board_.measured("Good.");
  nlohmann::json line = polite.next();
  EXPECT_TRUE(line.is_object());
}

TEST_F(StatusShown, IsNotHeldUpByOneWhoDoesNotRead) {
  Client deaf(socket_);
  ASSERT_TRUE(deaf.good());
  const std::string long_text(100000, 'x');  // three fill what the kernel keeps for it
  for (int k = 0; k < 10; ++k) {
    board_.advised(long_text + std::to_string(k));
    std::this_thread::sleep_for(120ms);
  }
  Client polite(socket_);
  EXPECT_TRUE(polite.next().is_object());
}

// The name of a socket outlives whoever made it.
void leave_a_socket(const std::string& path) {
  const int left = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(left, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(left);
}

TEST_F(StatusShown, IsReachedAgainAfterADaemonThatWasKilled) {
  server_.reset();
  leave_a_socket(socket_);
  auto server = StatusServer::start(board_, socket_, file_);
  ASSERT_TRUE(server) << server.error().sentence;
  EXPECT_TRUE(Client(socket_).good());
  server->reset();
  EXPECT_FALSE(std::filesystem::exists(socket_));
}

TEST_F(StatusShown, TakesNoOtherDaemonsSocket) {
  const auto second = StatusServer::start(board_, socket_, file_);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().sentence, HasSubstr("second plumblined"));
  EXPECT_TRUE(Client(socket_).good());
}

TEST_F(StatusShown, TakesTheNameOfNothingElse) {
  const std::string precious = folder_.write("precious", std::string("kept"));
  const auto server = StatusServer::start(board_, precious, file_);
  ASSERT_FALSE(server);
  EXPECT_THAT(server.error().sentence, HasSubstr("something else is there"));
  EXPECT_EQ(std::filesystem::file_size(precious), 4u);
}

TEST_F(StatusShown, RefusesAPathThatIsNoneInASentence) {
  const auto nowhere = StatusServer::start(board_, (folder_.path() / "no/socket").string(), "");
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(nowhere.error().sentence, HasSubstr("is its folder there"));
  const auto longer = StatusServer::start(board_, "/" + std::string(200, 'a'), "");
  ASSERT_FALSE(longer);
  EXPECT_THAT(longer.error().sentence, HasSubstr("too long"));
}

}  // namespace
}  // namespace plumbline::service
