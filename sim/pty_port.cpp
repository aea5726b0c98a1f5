// SPDX-License-Identifier: MIT
#include "sim/pty_port.h"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace plumbline::sim {
namespace {

// Until someone opens it as a port, the terminal would echo what it gets back to us.
void make_raw(int master) {
  termios settings{};
  if (::tcgetattr(master, &settings) != 0) return;
  ::cfmakeraw(&settings);
  ::tcsetattr(master, TCSANOW, &settings);
}

}  // namespace

Status PtyPort::plug_in() {
  pull();
  std::array<char, 128> slave{};
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
      ::ptsname_r(master_, slave.data(), slave.size()) != 0) {
    return Error{std::string("There is no pseudo-terminal to be had: ") + std::strerror(errno) +
                 "; mount /dev/pts."};
  }
  make_raw(master_);
  if (::symlink(slave.data(), path_.c_str()) == 0) return Done{};
  return Error{"Cannot make " + path_ + ": " + std::strerror(errno) +
               "; choose a path in a folder that is there."};
}

void PtyPort::pull() {
  if (master_ < 0) return;
  ::unlink(path_.c_str());
  ::close(master_);
  master_ = -1;
}

void PtyPort::send(std::string_view bytes) {
  while (master_ >= 0 && !bytes.empty()) {
    const ssize_t written = ::write(master_, bytes.data(), bytes.size());
    if (written <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string PtyPort::received() {
  std::string bytes;
  std::array<char, 1024> buffer{};
  while (master_ >= 0) {
    const ssize_t count = ::read(master_, buffer.data(), buffer.size());
    if (count <= 0) break;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return bytes;
}

}  // namespace plumbline::sim
