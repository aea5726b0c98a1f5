// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/posix/descriptor.h"

namespace plumbline::hil {

// Lines of text to and from a character device of QEMU's. One thread.
class LineSocket {
 public:
  // Tries for 30 s; false where nobody listens.
  bool open(const std::string& path);

  // With an end of line.
  bool say(std::string_view line);

  // The next line, without its end. Empty when `deadline` is over or QEMU has gone.
  std::optional<std::string> next(std::chrono::steady_clock::time_point deadline);

  bool is_open() const { return socket_.is_open(); }

 private:
  posix::Descriptor socket_;
  std::string received_;
};

}  // namespace plumbline::hil
