// SPDX-License-Identifier: MIT
#include "tests/hil/host/line_socket.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

#include "tests/hil/host/usbredir.h"

namespace plumbline::hil {

bool LineSocket::open(const std::string& path) {
  socket_ = connect_patiently(path);
  return socket_.is_open();
}

bool LineSocket::say(std::string_view line) {
  std::string bytes(line);
  bytes += '\n';
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t size =
        ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (size <= 0) return false;
    sent += static_cast<std::size_t>(size);
  }
  return true;
}

std::optional<std::string> LineSocket::next(std::chrono::steady_clock::time_point deadline) {
  using std::chrono::milliseconds;
  for (;;) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    const auto left = std::chrono::ceil<milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left <= milliseconds(0) || !socket_.is_open()) return std::nullopt;
    pollfd ready{socket_.get(), POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(std::min(left, milliseconds(60000)).count())) <= 0)
      continue;
    std::array<char, 4096> bytes{};
    const ssize_t size = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (size <= 0) socket_.close();
    if (size > 0) received_.append(bytes.data(), static_cast<std::size_t>(size));
  }
}

}  // namespace plumbline::hil
