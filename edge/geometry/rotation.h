// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace plumbline::geometry {

// The attitude of a photo in photogrammetric angles, radians. With the photo frame x right, y up,
// z towards the viewer (the camera looks along -z) and the ground frame east, north, up, a photo
// that looks straight down with its top to the north has omega = phi = kappa = 0.
struct OmegaPhiKappa {
  double omega_rad = 0;
  double phi_rad = 0;
  double kappa_rad = 0;
};

// R = Rx(omega) Ry(phi) Rz(kappa), turns photo-frame vectors into ground-frame vectors.
// Source: Kunii and Kumazaki 2018, eq. 3 (the order of its three matrices).
Eigen::Matrix3d ground_from_photo(const OmegaPhiKappa& angles);

// The inverse; phi in [-pi/2, pi/2], omega and kappa in (-pi, pi].
OmegaPhiKappa angles_of(const Eigen::Matrix3d& ground_from_photo);

// d(omega, phi, kappa) / d(delta) for the increment exp([delta]x) * ground_from_photo, delta in
// the ground frame, radians. Row order omega, phi, kappa. Singular at phi = +-90 degrees.
Eigen::Matrix3d angles_by_ground_increment(const OmegaPhiKappa& angles);

// exp([delta]x): the rotation by |delta| radians about delta (Rodrigues).
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& delta_rad);

// d(rotation vector) by delta of exp([delta]x) exp([vector]x): the inverse of the left Jacobian of
// SO(3) (Barfoot 2017, State Estimation for Robotics, eq. 7.85). |vector| < 2 pi.
Eigen::Matrix3d rotation_vector_by_increment(const Eigen::Vector3d& vector_rad);

// [v]x, the matrix with cross_matrix(v) * w = v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

}  // namespace plumbline::geometry
