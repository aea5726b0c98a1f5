// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "edge/base/ring.h"
#include "edge/base/time.h"

namespace plumbline::capture {

// The antenna's height as one fix had it.
struct HeightSeen {
  HostTime time;
  double height_m = 0;  // ellipsoidal
  double sigma_m = 0;
  double climb_m_s = 0;
};

// The height at which the antenna stands, ellipsoidal: the mean of the last ten seconds but the
// last three, which may belong to a take-off already. It follows what drifts, falls at once when
// the antenna stands lower, and rises only where it has stood higher for a minute, for a drone may
// hover low before it climbs. Found by a position that was bad, it rises as quickly as it falls
// once there is a better one, as far as the bad one may have been wrong. Pure.
class Ground {
 public:
  void add(const HeightSeen& seen);
  void set(double height_m);

  std::optional<double> height_m() const { return height_m_; }
  double sigma_m() const { return sigma_m_; }

 private:
  struct Second {
    std::int64_t number = 0;
    double sum_m = 0;
    int count = 0;
    double sigma_m = 0;  // of its last fix: the first ones after a start know less
    double mean_m() const { return sum_m / count; }
  };

  void begin_second(std::int64_t number);
  bool is_flat(std::size_t seconds, double doubt_m) const;

  static constexpr std::size_t kSeconds = 13;

  Ring<Second> seconds_{kSeconds};  // oldest first; the last one is under way
  int flat_seconds_ = 0;            // so many in a row were as high as the one after them
  std::optional<double> height_m_;
  double sigma_m_ = 0;  // of the receiver when it was found
};

}  // namespace plumbline::capture
