// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/posix/descriptor.h"
#include "drivers/posix/system_clock.h"
#include "edge/base/time.h"

namespace plumbline::contract {

// The same instant on our clock and on that of another machine.
struct ClockTie {
  HostTime ours;
  std::int64_t theirs_ns = 0;
  std::chrono::nanoseconds doubt{};  // half of the round trip: `ours` is within it
};

// The other machine's clock, asked for through a port: "time" is answered by a line of nanoseconds.
class FarClock {
 public:
  // A character device that takes lines.
  explicit FarClock(const std::string& path);
  bool is_open() const { return port_.is_open(); }

  void say(std::string_view line);
  // The middle of the shortest of many round trips. Empty when nobody answers within a second.
  std::optional<ClockTie> tie();

 private:
  std::optional<ClockTie> ask();
  std::optional<std::int64_t> answer();

  posix::SystemClock clock_;
  posix::Descriptor port_;
};

// What our clock showed when theirs showed `theirs_ns`, by a line through two ties.
HostTime ours_of(std::int64_t theirs_ns, const ClockTie& first, const ClockTie& last);

}  // namespace plumbline::contract
