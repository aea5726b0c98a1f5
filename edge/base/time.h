// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace plumbline {

// The one clock by which the host's devices are timed: Linux's CLOCK_MONOTONIC, which starts near
// zero at boot, is never set, and runs at a rate that is wrong by up to 100 ppm. It has no now()
// here: only a Clock (drivers/clock.h) can tell the time.
struct HostClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<HostClock>;
  static constexpr bool is_steady = true;
};
using HostTime = HostClock::time_point;

// Time of the GPS: seconds since 1980-01-06 00:00:00 UTC, no leap seconds. Conversion to and from
// UTC: edge/gnss/leap_seconds.h.
struct GpsClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<GpsClock>;
  static constexpr bool is_steady = true;
};
using GpsTime = GpsClock::time_point;

// What the system believes the calendar says (CLOCK_REALTIME): it jumps when it is set, and after a
// start without network it is wrong by years. For names and logs only; nothing is ordered by it.
using WallTime = std::chrono::sys_time<std::chrono::nanoseconds>;

// A duration for arithmetic, and back to the nearest nanosecond.
inline double in_seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}
inline std::chrono::nanoseconds from_seconds(double value_s) {
  return std::chrono::nanoseconds(std::llround(value_s * 1e9));
}

}  // namespace plumbline
