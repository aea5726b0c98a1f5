// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "edge/base/time.h"

namespace plumbline {

// The same instant on two clocks: the wall clock, read between two readings of the host clock.
struct WallReading {
  HostTime host;  // middle of the two host readings
  WallTime wall;
  std::chrono::nanoseconds spread{};  // between the two: `wall` is within half of it
};

}  // namespace plumbline
