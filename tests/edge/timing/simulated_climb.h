// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "edge/geodesy/local_frame.h"
#include "edge/gnss/leap_seconds.h"
#include "sim/gnss_error.h"
#include "tests/edge/timing/simulated_arrivals.h"

namespace plumbline::timing {

// A climb that stops now and then, in gusts; typed in for the tests, 100 steps a second.
class SimulatedClimb {
 public:
  static constexpr double kStep_s = 0.01;

  SimulatedClimb(double rate_m_s, double duration_s, double gust_m_s2, sim::Random& random) {
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d gust = Eigen::Vector3d::Zero();
    double wanted_m_s = rate_m_s;
    double led_m_s = 0;  // what the pilot's stick leads to, at 2 m/s2
    for (double t_s = 0; t_s < duration_s; t_s += kStep_s) {
      if (random.uniform() < kStep_s / 6) wanted_m_s = wanted_m_s > 0 ? 0 : rate_m_s;
      led_m_s += std::clamp(wanted_m_s - led_m_s, -2 * kStep_s, 2 * kStep_s);
      for (int axis = 0; axis < 3; ++axis) {
        gust[axis] += -gust[axis] * kStep_s + gust_m_s2 * std::sqrt(2 * kStep_s) * random.normal();
      }
      const Eigen::Vector3d led{0.3, -0.2, led_m_s};
      velocity_m_s += kStep_s * ((led - velocity_m_s) / 0.3 + gust);
      position_m += kStep_s * velocity_m_s;
      positions_m_.push_back(position_m);
    }
  }

  Eigen::Vector3d at(double t_s) const {
    const double place = std::clamp(t_s / kStep_s, 0.0, double(positions_m_.size()) - 2.001);
    const auto k = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(k);
    return (1 - share) * positions_m_[k] + share * positions_m_[k + 1];
  }

 private:
  std::vector<Eigen::Vector3d> positions_m_;
};

inline geodesy::LocalFrame climb_frame() { return *geodesy::LocalFrame::at({35.6, 139.7, 50.0}); }

inline GnssFix fix_at(double t_s, const Eigen::Vector3d& enu_m, const Eigen::Vector3d& sigma_m) {
  const geodesy::Geodetic place = climb_frame().geodetic_of(enu_m);
  GnssFix fix;
  fix.time = gnss::utc_of(kGpsStart + of_seconds(t_s));
  fix.quality = FixQuality::kFixed;
  fix.latitude_deg = place.latitude_deg;
  fix.longitude_deg = place.longitude_deg;
  fix.height_ellipsoidal_m = place.height_ellipsoidal_m;
  fix.covariance_enu_m2 = sigma_m.cwiseAbs2().asDiagonal();
  return fix;
}

}  // namespace plumbline::timing
