// SPDX-License-Identifier: MIT
#include "edge/capture/take_off.h"

#include <algorithm>
#include <cmath>

namespace plumbline::capture {
namespace {

constexpr double kStillBelow_m_s = 0.5;
constexpr double kRiseSigmas = 3;

}  // namespace

void TakeOffWatch::add(const HeightSeen& seen) {
  ground_.add(seen);
  const double rise_m = seen.height_m - *ground_.height_m();
  const double doubt_m = kRiseSigmas * std::hypot(seen.sigma_m, ground_.sigma_m());
  const bool still = std::abs(seen.climb_m_s) < kStillBelow_m_s;
  above_.keep(rise_m >= std::max(options_.rise_m, doubt_m), seen.time);
  low_.keep(still && rise_m < std::max(options_.landed_below_m, doubt_m), seen.time);
}

bool TakeOffWatch::has_taken_off(HostTime now) const {
  if (options_.by_pilot) return armed_.value_or(false);
  return above_.lasted(now, options_.rise_lasts);
}

bool TakeOffWatch::has_landed(HostTime now) const {
  if (options_.by_pilot && armed_) return !*armed_;
  return low_.lasted(now, options_.landed_lasts);
}

}  // namespace plumbline::capture
