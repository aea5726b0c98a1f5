// SPDX-License-Identifier: MIT
#include "edge/capture/ground.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plumbline::capture {
namespace {

constexpr std::size_t kNotYet = 3;  // the last seconds, which do not count
constexpr double kNearby_m = 0.3;   // as high as the ground, or three sigmas
constexpr double kGroundSigmas = 3;
constexpr int kLower_s = 4;    // flat for so long below the ground: this is the ground
constexpr int kHigher_s = 60;  // and above it

}  // namespace

void Ground::set(double height_m) {
  height_m_ = height_m;
  sigma_m_ = 0;
}

void Ground::add(const HeightSeen& seen) {
  if (!height_m_) {
    height_m_ = seen.height_m;
    sigma_m_ = seen.sigma_m;
  }
  const auto number =
      std::chrono::floor<std::chrono::seconds>(seen.time.time_since_epoch()).count();
  if (seconds_.empty() || seconds_.back().number != number) {
    begin_second(number);
  }
  seconds_.back().sigma_m = seen.sigma_m;
  seconds_.back().sum_m += seen.height_m;
  ++seconds_.back().count;
}

bool Ground::is_flat(std::size_t seconds, double doubt_m) const {
  if (seconds_.size() < seconds) return false;
  const double last_m = seconds_.back().mean_m();
  for (std::size_t k = seconds_.size() - seconds; k < seconds_.size(); ++k) {
    if (std::abs(seconds_[k].mean_m() - last_m) > doubt_m) return false;
  }
  return true;
}

// The second before is complete: what does it say?
void Ground::begin_second(std::int64_t number) {
  if (!seconds_.empty()) {
    const double sigma_m = seconds_.back().sigma_m;
    const double doubt_m = std::max(kNearby_m, kGroundSigmas * sigma_m);
    const double last_m = seconds_.back().mean_m();
    flat_seconds_ = is_flat(2, doubt_m / 2) ? flat_seconds_ + 1 : 0;
    const double rise_m = last_m - *height_m_;
    const bool here = std::abs(rise_m) <= doubt_m;
    const bool better = sigma_m < sigma_m_ && rise_m <= kGroundSigmas * sigma_m_;
    const int settled_s = rise_m < 0 || better ? kLower_s : kHigher_s;
    if (!here && flat_seconds_ >= settled_s && is_flat(kLower_s, doubt_m)) {
      height_m_ = last_m;
      sigma_m_ = sigma_m;
    }
    if (here && seconds_.size() > kNotYet && is_flat(seconds_.size(), doubt_m)) {
      const std::size_t counted = seconds_.size() - kNotYet;
      double sum_m = 0;
      sigma_m_ = 0;
      for (std::size_t k = 0; k < counted; ++k) {
        sum_m += seconds_[k].mean_m();
        sigma_m_ = std::max(sigma_m_, seconds_[k].sigma_m);
      }
      height_m_ = sum_m / static_cast<double>(counted);
    }
  }
  seconds_.push_back({number, 0, 0, 0});
}

}  // namespace plumbline::capture
