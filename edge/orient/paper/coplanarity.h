// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "edge/geometry/camera.h"

namespace plumbline::orient::paper {

// A point seen in photo 1 and in photo i.
struct PairObservation {
  Eigen::Vector2d pixel_1 = Eigen::Vector2d::Zero();
  Eigen::Vector2d pixel_i = Eigen::Vector2d::Zero();
  double sigma_1_px = 1;
  double sigma_i_px = 1;
};

// The coplanarity condition of a pair, over what image noise does to it: in sigmas.
struct Coplanarity {
  double residual = 0;
  double sampson_px = 0;  // the same in pixels, sigmas aside
  Eigen::Matrix<double, 1, geometry::kInteriorCount> by_interior;
  Eigen::RowVector3d by_rotation;  // increment exp([d]x) R on the left
  Eigen::RowVector3d by_base;
};

// Kunii and Kumazaki 2018, eq. 3: | B, r1, R ri | = 0 with r1, ri the rays (x, y, -1) after eq. 4
// (f divided out; the B that the paper adds to the third row changes no determinant). Photo 1 at
// the origin without tilt, photo i at `pose`. The weight is held while deriving. Empty where a
// pixel has no ray.
std::optional<Coplanarity> coplanarity(const geometry::InteriorVector& interior,
                                       const geometry::Pose& pose, const PairObservation& seen);

}  // namespace plumbline::orient::paper
