// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "edge/base/time.h"

namespace plumbline {

// When light fell on a frame. Row r was exposed from `first_row_start + r * row_time` for
// `exposure`. `sigma` is one standard deviation of the exposure's middle; what the driver cannot
// know (a webcam's exposure, a delay inside the camera) is in it. Made from what a camera says by
// edge/timing/exposure_time.h.
struct ExposureTiming {
  HostTime first_row_start;
  std::chrono::nanoseconds exposure{};
  std::chrono::nanoseconds row_time{};  // 0: global shutter, or not known (then in sigma)
  std::chrono::nanoseconds sigma{};

  // Middle of the exposure of a row, counted from the top, halves allowed.
  HostTime middle_of_row(double row) const;
};

}  // namespace plumbline
