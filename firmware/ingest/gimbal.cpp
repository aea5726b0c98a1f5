// SPDX-License-Identifier: MIT
#include "firmware/ingest/gimbal.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::ingest {
namespace {

// Gimbals hold 0.02 degrees against shaking, but their level is that of an inertial sensor and the
// camera's seat in them is not calibrated.
constexpr double kTiltSigmaDeg = 1.5;
// A compass beside motors, after declination.
constexpr double kCompassSigmaDeg = 5;
constexpr double kMostTiltDeg = 60;

}  // namespace

Eigen::Matrix3d ground_from_photo_of(const GimbalAttitude& gimbal) {
  const double yaw = gimbal.yaw_deg.value_or(0) * kRadPerDeg;
  const double pitch = gimbal.pitch_deg * kRadPerDeg;
  const double roll = gimbal.roll_deg * kRadPerDeg;
  const Eigen::Vector3d forward(std::cos(pitch) * std::sin(yaw), std::cos(pitch) * std::cos(yaw),
                                std::sin(pitch));
  // Where forward points as the pitch grows: towards the yaw's azimuth for a camera that looks
  // down.
  const Eigen::Vector3d level_up(-std::sin(pitch) * std::sin(yaw), -std::sin(pitch) * std::cos(yaw),
                                 std::cos(pitch));
  const Eigen::Vector3d level_right = forward.cross(level_up);
  const Eigen::Vector3d right = std::cos(roll) * level_right - std::sin(roll) * level_up;
  Eigen::Matrix3d ground_from_photo;
  ground_from_photo << right, -forward.cross(right), -forward;
  return ground_from_photo;
}

GimbalPriors gimbal_priors(const GimbalAttitude& gimbal) {
  const Eigen::Matrix3d ground_from_photo = ground_from_photo_of(gimbal);
  const double tilt_deg = std::acos(std::min(1.0, ground_from_photo(2, 2))) * kDegPerRad;
  if (!(tilt_deg < kMostTiltDeg)) return {};
  GimbalPriors priors;
  if (gimbal.yaw_deg || tilt_deg < kTiltSigmaDeg) {
    const geometry::OmegaPhiKappa angles = geometry::angles_of(ground_from_photo);
    orient::AttitudePrior attitude;
    attitude.omega_phi_kappa_rad = {angles.omega_rad, angles.phi_rad, angles.kappa_rad};
    const double sigma = kTiltSigmaDeg * kRadPerDeg;
    attitude.sigma_rad = {sigma, sigma, std::numeric_limits<double>::infinity()};
    priors.attitude = attitude;
  }
  if (gimbal.yaw_deg) {
    const Eigen::Vector3d top = ground_from_photo.col(1);
    priors.heading =
        orient::HeadingPrior{std::atan2(top.x(), top.y()), kCompassSigmaDeg * kRadPerDeg};
  }
  return priors;
}

}  // namespace plumbline::ingest
