// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "edge/base/gnss_fix.h"
#include "edge/base/time.h"

namespace plumbline {

// Whether a fix is a position to work with: measured (not dead reckoning, typed in or simulated),
// with latitude and longitude.
bool is_measured_position(const GnssFix& fix);

struct Jump {
  double distance_m = 0;
  double seconds = 0;  // between the two fixes
};

// Finds positions that the antenna cannot have reached from the one before: farther than it flies
// in the time between, and than both may be wrong. That is six of their sigmas, and at least 1 m
// when fixed, 5 m when float, 10 m with corrections, 30 m without (a wrong sigma is no jump).
class JumpCheck {
 public:
  explicit JumpCheck(double fastest_m_s = 30) : fastest_m_s_(fastest_m_s) {}

  // `fix` is a measured position; the next one is compared with it. Heights are compared where both
  // have one. The time between is the receiver's own, or that of arrival where it says none.
  std::optional<Jump> take(const GnssFix& fix, HostTime arrival);

 private:
  struct Seen {
    GnssFix fix;
    HostTime arrival;
  };

  double fastest_m_s_;
  std::optional<Seen> before_;
};

}  // namespace plumbline
