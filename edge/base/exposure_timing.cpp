// SPDX-License-Identifier: MIT
#include "edge/base/exposure_timing.h"

#include <cmath>

namespace plumbline {

HostTime ExposureTiming::middle_of_row(double row) const {
  const double after_ns =
      row * static_cast<double>(row_time.count()) + 0.5 * static_cast<double>(exposure.count());
  return first_row_start + std::chrono::nanoseconds(std::llround(after_ns));
}

}  // namespace plumbline
