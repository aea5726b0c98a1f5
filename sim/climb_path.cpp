// SPDX-License-Identifier: MIT
#include "sim/climb_path.h"

#include <algorithm>
#include <cmath>

#include "sim/random.h"

namespace plumbline::sim {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kLag_s = 0.4;
constexpr double kMost_m_s2 = 2;
constexpr double kBob_s = 1.2;
constexpr double kPause_s = 4;
constexpr double kLongest_s = 3600;

// What the pilot asks for from moment to moment.
class Pilot {
 public:
  Pilot(const ClimbPathOptions& options, Random& random) : options_(options), random_(random) {}

  Eigen::Vector3d velocity_m_s(const Eigen::Vector3d& place_m) {
    if (place_m.z() >= options_.top_m) at_top_ = true;
    if (!at_top_) return {0, 0, climb_m_s()};
    if (place_m.x() < options_.aside_m && !aside_done_) {
      return {options_.aside_m_s, 0, std::clamp(options_.top_m - place_m.z(), -1.0, 1.0)};
    }
    aside_done_ = true;
    return {0, 0, -std::clamp(place_m.z(), 0.5, options_.descent_m_s)};
  }
  bool is_down(const Eigen::Vector3d& place_m) const { return aside_done_ && place_m.z() <= 0; }

 private:
  double climb_m_s() {
    if (left_s_ > 0) {
      left_s_ -= kStep_s;
      return whim_m_s_;
    }
    if (random_.uniform() < options_.bobs_per_s * kStep_s) {
      left_s_ = kBob_s;
      whim_m_s_ = -1;
    }
    if (random_.uniform() < options_.pauses_per_s * kStep_s) {
      left_s_ = kPause_s;
      whim_m_s_ = 0;
    }
    return options_.climb_m_s;
  }

  const ClimbPathOptions& options_;
  Random& random_;
  bool at_top_ = false;
  bool aside_done_ = false;
  double left_s_ = 0;  // of a whim
  double whim_m_s_ = 0;
};

}  // namespace

ClimbPath::ClimbPath(const ClimbPathOptions& options, std::uint64_t seed) {
  Random random(seed, 31);
  Pilot pilot(options, random);
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d led_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d gust_m_s = Eigen::Vector3d::Zero();
  const Eigen::Vector3d rms_m_s(options.sideways_m_s, options.sideways_m_s, options.gust_m_s);
  const auto stand = [&](double seconds) {
    places_m_.insert(places_m_.end(), static_cast<std::size_t>(seconds / kStep_s), place_m);
  };
  stand(options.wait_s);
  for (double time_s = 0; time_s < kLongest_s && !pilot.is_down(place_m); time_s += kStep_s) {
    const Eigen::Vector3d pull_m_s2 = (pilot.velocity_m_s(place_m) - led_m_s) / kLag_s;
    led_m_s += kStep_s * pull_m_s2.cwiseMax(-kMost_m_s2).cwiseMin(kMost_m_s2);
    for (int axis = 0; axis < 3; ++axis) {
      const double share = kStep_s / options.gust_s;
      gust_m_s[axis] +=
          -share * gust_m_s[axis] + std::sqrt(2 * share) * rms_m_s[axis] * random.normal();
    }
    place_m += kStep_s * (led_m_s + gust_m_s);
    places_m_.push_back(place_m);
  }
  stand(options.landed_s);
}

Eigen::Vector3d ClimbPath::at(double seconds) const {
  const double last = static_cast<double>(places_m_.size()) - 1.001;
  const double index = std::clamp(seconds / kStep_s, 0.0, last);
  const auto k = static_cast<std::size_t>(index);
  const double share = index - static_cast<double>(k);
  return (1 - share) * places_m_[k] + share * places_m_[k + 1];
}

double ClimbPath::duration_s() const { return static_cast<double>(places_m_.size()) * kStep_s; }

}  // namespace plumbline::sim
