// SPDX-License-Identifier: MIT
#include "firmware/service/status_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

namespace plumbline::service {
namespace {

constexpr int kLookEvery_ms = 100;
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

}  // namespace

Result<std::unique_ptr<StatusServer>> StatusServer::start(const StatusBoard& board,
                                                          const std::string& socket_path,
                                                          const std::string& file_path) {
  const auto listener = listen_at(socket_path);
  if (!listener) return listener.error();
  return std::unique_ptr<StatusServer>(new StatusServer(board, *listener, socket_path, file_path));
}

StatusServer::StatusServer(const StatusBoard& board, int listener, std::string socket_path,
                           std::string file_path)
    : board_(board),
      listener_(listener),
      socket_path_(std::move(socket_path)),
      file_path_(std::move(file_path)),
      thread_([this] { run(); }) {}

StatusServer::~StatusServer() {
  stopping_ = true;
  thread_.join();
  for (const int client : clients_) ::close(client);
  if (listener_ < 0) return;
  ::close(listener_);
  ::unlink(socket_path_.c_str());
}

void StatusServer::run() {
  std::uint64_t told = ~std::uint64_t{0};
  std::string line;
  while (!stopping_) {
    pollfd waiting{listener_, POLLIN, 0};
    ::poll(&waiting, listener_ >= 0 ? 1 : 0, kLookEvery_ms);
    const std::uint64_t version = board_.version();
    if (version != told) {
      told = version;
      line = board_.json() + '\n';
      write_file(line);  // first: who is told a line finds it there
      tell(line);
    }
    if ((waiting.revents & POLLIN) != 0) admit(line);
  }
}

void StatusServer::admit(const std::string& line) {
  const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (client < 0) return;
  const bool taken =
      ::send(client, line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size());
  if (taken && clients_.size() < kMostClients) {
    clients_.push_back(client);
  } else {
    ::close(client);
  }
}

void StatusServer::tell(const std::string& line) {
  std::erase_if(clients_, [&](int client) {
    const ssize_t sent = ::send(client, line.data(), line.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(line.size())) return false;
    ::close(client);
    return true;
  });
}

// Whole or not at all; not durable: it is of no use after a restart.
void StatusServer::write_file(const std::string& line) const {
  if (file_path_.empty()) return;
  const std::string part = file_path_ + ".part";
  std::ofstream file(part);
  file << line;
  file.close();
  if (file) std::rename(part.c_str(), file_path_.c_str());
}

}  // namespace plumbline::service
