// SPDX-License-Identifier: MIT
#include "firmware/service/status_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

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
