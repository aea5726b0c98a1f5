// SPDX-License-Identifier: MIT
#include "edge/capture/take_off.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plumbline::capture {
namespace {

constexpr double kStillBelow_m_s = 0.5;
constexpr double kRiseSigmas = 3;
constexpr std::chrono::seconds kHeardOfLate{3};

}  // namespace

void TakeOffWatch::add(const HeightSeen& seen) {
  ground_.add(seen);
  const double rise_m = seen.height_m - *ground_.height_m();
  const double doubt_m = kRiseSigmas * std::hypot(seen.sigma_m, ground_.sigma_m());
  const bool still = std::abs(seen.climb_m_s) < kStillBelow_m_s;
  above_.keep(rise_m >= std::max(options_.rise_m, doubt_m), seen.time);
  low_.keep(still && rise_m < std::max(options_.landed_below_m, doubt_m), seen.time);
}

void TakeOffWatch::add(const PilotHeight& height) {
  if (!above_arming_m(height.time)) {  // after a silence
    pilot_above_ = {};
    pilot_low_ = {};
  }
  pilot_height_ = height;
  const bool still = std::abs(height.climb_m_s) < kStillBelow_m_s;
  pilot_above_.keep(height.above_arming_m >= options_.rise_m, height.time);
  pilot_low_.keep(still && height.above_arming_m < options_.landed_below_m, height.time);
}

std::optional<double> TakeOffWatch::above_arming_m(HostTime now) const {
  if (!pilot_height_ || now - pilot_height_->time > kHeardOfLate) return std::nullopt;
  return pilot_height_->above_arming_m;
}

bool TakeOffWatch::asks_altitude(HostTime now) const {
  return options_.by == TakeOffBy::kRelativeAltitude && above_arming_m(now);
}

bool TakeOffWatch::has_taken_off(HostTime now) const {
  if (options_.by == TakeOffBy::kArmed && armed_) return *armed_;
  return (asks_altitude(now) ? pilot_above_ : above_).lasted(now, options_.rise_lasts);
}

bool TakeOffWatch::has_landed(HostTime now) const {
  if (options_.by == TakeOffBy::kArmed && armed_) return !*armed_;
  return (asks_altitude(now) ? pilot_low_ : low_).lasted(now, options_.landed_lasts);
}

}  // namespace plumbline::capture
