// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/image/homography.h"

namespace plumbline::image {

struct Prediction {
  LocalMap map;
  double radius_px = 0;  // the point should be within this of map.target_px
};

// Says where points of one photo are in another: by their homography, corrected by what nearby
// matches lie off it (relief, lens distortion).
class Predictor {
 public:
  // `matches` run from the reference (first) to the target (second), like the homography.
  Predictor(const Eigen::Matrix3d& target_from_reference,
            const std::vector<Correspondence>& matches, double target_width_px);

  Prediction predict(const Eigen::Vector2d& reference_px) const;

 private:
  Eigen::Matrix3d homography_;
  std::vector<Eigen::Vector2d> place_px_;
  std::vector<Eigen::Vector2d> residual_px_;
  double least_radius_px_;
  double most_radius_px_;
};

}  // namespace plumbline::image
