// SPDX-License-Identifier: MIT
#pragma once

#include <time.h>

#include "edge/base/time.h"

namespace plumbline {

// The clock by which the kernel stamps frames.
inline HostTime monotonic_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return HostTime(std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec));
}

}  // namespace plumbline
