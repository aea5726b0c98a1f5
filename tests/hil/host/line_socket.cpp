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
  using std::chrono::nanoseconds;
  for (;;) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    const std::chrono::nanoseconds left = deadline - std::chrono::steady_clock::now();
    if (left <= nanoseconds(0) || !socket_.is_open()) return std::nullopt;
    pollfd ready{socket_.get(), POLLIN, 0};
    const auto whole = std::chrono::floor<std::chrono::seconds>(left);
    const timespec at_most{whole.count(), (left - whole).count()};
    if (::ppoll(&ready, 1, &at_most, nullptr) <= 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t size = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (size <= 0) socket_.close();
    if (size > 0) received_.append(bytes.data(), static_cast<std::size_t>(size));
  }
}

}  // namespace plumbline::hil
