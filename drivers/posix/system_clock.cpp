// SPDX-License-Identifier: MIT
#include "drivers/posix/system_clock.h"

namespace plumbline::posix {

// libstdc++ reads CLOCK_MONOTONIC for its steady clock.
HostTime SystemClock::now() const {
  return HostTime(std::chrono::steady_clock::now().time_since_epoch());
}

WallReading SystemClock::wall() const {
  constexpr int kAttempts = 5;
  WallReading best;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const HostTime before = now();
    const WallTime wall = std::chrono::system_clock::now();
    const auto spread = now() - before;
    if (attempt == 0 || spread < best.spread) best = {before + spread / 2, wall, spread};
  }
  return best;
}

bool SystemClock::wait(Signal& signal, HostTime deadline) {
  return signal.take_until(std::chrono::steady_clock::time_point(deadline.time_since_epoch()));
}

}  // namespace plumbline::posix
