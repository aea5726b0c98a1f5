// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "edge/base/time.h"
#include "edge/base/wall_reading.h"

namespace plumbline::timing {

struct WallOptions {
  double slew_limit = 600e-6;  // adjtime and NTP steer by 500 ppm at most, crystals by 100
  std::chrono::nanoseconds least_step = std::chrono::microseconds(2);
};

struct StampOnHost {
  HostTime time;
  std::chrono::nanoseconds sigma{};
};

// A stamp of the wall clock (/dev/pps) on the host clock, from a pair taken before it and one after
// it. Empty where the stamp does not lie between them, or where the wall clock was stepped in
// between: then the stamp's own side is not known.
std::optional<StampOnHost> host_of_wall(WallTime stamp, const WallReading& before,
                                        const WallReading& after, const WallOptions& options = {});

}  // namespace plumbline::timing
