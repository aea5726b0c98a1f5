// SPDX-License-Identifier: MIT
#include "firmware/service/status/status_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

namespace plumbline::service {
namespace {

constexpr int kLookEvery_ms = 100;
constexpr std::chrono::seconds kShowEvery{1};  // what changes without being told at once
constexpr std::size_t kMostClients = 16;

Error cannot(const std::string& path) {
  return {"Cannot make the status socket " + path + ": " + std::strerror(errno) +
          "; is its folder there, and may this user write to it?"};
}

// Only the socket of a daemon that was killed goes: nothing answers there.
Status clear_the_way(const std::string& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return Done{};
  if (!S_ISSOCK(found.st_mode)) {
    return Error{"The status socket " + path +
                 " cannot be made: something else is there; move it away, or name another path."};
  }
  const int client = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const bool answers =
      ::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(client);
  if (answers) {
    return Error{"Another program answers at the status socket " + path +
                 ": is a second plumblined running? Stop it, or name another path."};
  }
  ::unlink(path.c_str());
  return Done{};
}

Result<int> listen_at(const std::string& path) {
  if (path.empty()) return -1;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    return Error{"The path of the status socket is too long: " + path + "."};
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (listener < 0) return cannot(path);
  if (Status clear = clear_the_way(path, address); !clear) {
    ::close(listener);
    return clear.error();
  }
  const bool good =
      ::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::listen(listener, 8) == 0;
  if (good) return listener;
  Error error = cannot(path);
  ::close(listener);
  return error;
}

// Whole or not at all; not durable: it is of no use after a restart.
Status write_whole(const std::string& path, const std::string& line) {
  const std::string part = path + ".part";
  errno = 0;
  std::ofstream file(part);
  file << line;
  file.close();
  if (file && std::rename(part.c_str(), path.c_str()) == 0) return Done{};
  const std::string reason = std::strerror(errno);
  std::remove(part.c_str());
  return Error{"Cannot write the status file " + path + ": " + reason +
               "; is its folder there, with room, and may this user write to it?"};
}

}  // namespace

Result<std::unique_ptr<StatusServer>> StatusServer::start(const StatusBoard& board,
                                                          const std::string& socket_path,
                                                          const std::string& file_path,
                                                          FileEvent file_event) {
  const auto listener = listen_at(socket_path);
  if (!listener) return listener.error();
  // Not before: the file of a daemon that runs is left to it.
  if (!file_path.empty()) {
    if (const Status written = write_whole(file_path, board.json() + '\n'); !written) {
      if (*listener >= 0) ::close(*listener);
      if (*listener >= 0) ::unlink(socket_path.c_str());
      return written.error();
    }
  }
  return std::unique_ptr<StatusServer>(
      new StatusServer(board, *listener, socket_path, file_path, std::move(file_event)));
}

StatusServer::StatusServer(const StatusBoard& board, int listener, std::string socket_path,
                           std::string file_path, FileEvent file_event)
    : board_(board),
      listener_(listener),
      socket_path_(std::move(socket_path)),
      file_path_(std::move(file_path)),
      file_event_(std::move(file_event)),
      thread_([this] { run(); }) {}

StatusServer::~StatusServer() {
  stopping_ = true;
  thread_.join();
  show();
  for (const int client : clients_) ::close(client);
  if (listener_ < 0) return;
  ::close(listener_);
  ::unlink(socket_path_.c_str());
}

void StatusServer::run() {
  using SteadyClock = std::chrono::steady_clock;
  std::uint64_t told = ~std::uint64_t{0};
  SteadyClock::time_point shown;
  while (!stopping_) {
    pollfd waiting{listener_, POLLIN, 0};
    ::poll(&waiting, listener_ >= 0 ? 1 : 0, kLookEvery_ms);
    const std::uint64_t version = board_.version();
    if (std::exchange(told, version) != version || SteadyClock::now() >= shown + kShowEvery) {
      shown = SteadyClock::now();
      show();
    }
    if ((waiting.revents & POLLIN) != 0) admit();
  }
}

void StatusServer::show() {
  const std::string line = board_.json() + '\n';
  if (!file_path_.empty()) {  // first: who is told a line finds it there
    const Status written = write_whole(file_path_, line);
    const bool was_good = std::exchange(file_is_good_, written.ok());
    if (was_good && !written) file_event_(false, written.error().sentence);
    if (!was_good && written) file_event_(true, "The status file is written again.");
  }
  std::erase_if(clients_, [&](int client) {
    const ssize_t sent = ::send(client, line.data(), line.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(line.size())) return false;
    ::close(client);
    return true;
  });
}

void StatusServer::admit() {
  const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (client < 0) return;
  const std::string line = board_.json() + '\n';
  const bool taken =
      ::send(client, line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size());
  if (taken && clients_.size() < kMostClients) {
    clients_.push_back(client);
  } else {
    ::close(client);
  }
}

}  // namespace plumbline::service
