// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "edge/base/result.h"
#include "edge/base/time.h"

namespace plumbline::posix {

// How many pulses the kernel has counted (wrapping at 2^32), and when the last one began.
struct PpsCount {
  std::uint32_t pulses = 0;
  WallTime last;
};

// Where pulses per second are counted: a PPS device of the kernel, or a test's.
class PpsSource {
 public:
  virtual ~PpsSource() = default;

  // Waits for the next pulse, `at_most` so long, and says where the count stands then; at once for
  // 0. Fails, with a sentence, when the device is gone.
  virtual Result<PpsCount> wait(std::chrono::nanoseconds at_most) = 0;
};

// "/dev/pps0", by the kernel's PPS API (RFC 2783; linux/pps.h).
Result<std::unique_ptr<PpsSource>> open_pps_source(const std::string& path);

}  // namespace plumbline::posix
