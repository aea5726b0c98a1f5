// SPDX-License-Identifier: MIT
#include "edge/geometry/rotation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace plumbline::geometry {
using Eigen::AngleAxisd;
using Eigen::Vector3d;

Eigen::Matrix3d ground_from_photo(const OmegaPhiKappa& angles) {
  return (AngleAxisd(angles.omega_rad, Vector3d::UnitX()) *
          AngleAxisd(angles.phi_rad, Vector3d::UnitY()) *
          AngleAxisd(angles.kappa_rad, Vector3d::UnitZ()))
      .toRotationMatrix();
}

// R(0,2) = sin phi; R(1,2), R(2,2) = cos phi (-sin omega, cos omega);
// R(0,1), R(0,0) = cos phi (-sin kappa, cos kappa).
OmegaPhiKappa angles_of(const Eigen::Matrix3d& r) {
  return {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
          std::atan2(-r(0, 1), r(0, 0))};
}

// The angular velocity in the ground frame is omega' ex + phi' Rx ey + kappa' Rx Ry ez; its
// inverse gives the angles by the increment.
Eigen::Matrix3d angles_by_ground_increment(const OmegaPhiKappa& angles) {
  const double co = std::cos(angles.omega_rad), so = std::sin(angles.omega_rad);
  const double cp = std::cos(angles.phi_rad), sp = std::sin(angles.phi_rad);
  Eigen::Matrix3d increment_by_angles;
  increment_by_angles.col(0) = Vector3d(1, 0, 0);
  increment_by_angles.col(1) = Vector3d(0, co, so);
  increment_by_angles.col(2) = Vector3d(sp, -so * cp, co * cp);
  return increment_by_angles.inverse();
}

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& delta_rad) {
  const double angle = delta_rad.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return AngleAxisd(angle, delta_rad / angle).toRotationMatrix();
}

Eigen::Matrix3d rotation_vector_by_increment(const Eigen::Vector3d& vector_rad) {
  constexpr double kSmall = 1e-3;
  const double angle = vector_rad.norm();
  const Eigen::Matrix3d cross = cross_matrix(vector_rad);
  const double second =
      angle < kSmall ? 1.0 / 12 : 1 / (angle * angle) - 1 / (2 * angle * std::tan(angle / 2));
  return Eigen::Matrix3d::Identity() - 0.5 * cross + second * cross * cross;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace plumbline::geometry
