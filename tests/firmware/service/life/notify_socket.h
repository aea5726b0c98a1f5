// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::service {

// A service manager's end of sd_notify(3): a datagram socket, a message a datagram. While it lives,
// NOTIFY_SOCKET names it.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const bool bound =
        ::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    if (bound) ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~NotifySocket() {
    ::unsetenv("NOTIFY_SOCKET");
    ::close(fd_);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  // The next message, waited for so long; empty where none came.
  std::optional<std::string> next(int milliseconds = 0) {
    pollfd readable{fd_, POLLIN, 0};
    if (::poll(&readable, 1, milliseconds) <= 0) return std::nullopt;
    char bytes[4096];
    const ssize_t size = ::recv(fd_, bytes, sizeof bytes, 0);
    if (size < 0) return std::nullopt;
    return std::string(bytes, static_cast<std::size_t>(size));
  }

  // All that came by now.
  std::vector<std::string> all() {
    std::vector<std::string> messages;
    while (auto message = next()) messages.push_back(std::move(*message));
    return messages;
  }

  // Waits for a message that holds `part`, a second for each of `tries` at most.
  bool hears(const std::string& part, int tries = 20) {
    for (int k = 0; k < tries; ++k) {
      const auto message = next(1000);
      if (message && message->find(part) != std::string::npos) return true;
    }
    return false;
  }

 private:
  int fd_ = -1;
};

}  // namespace plumbline::service
