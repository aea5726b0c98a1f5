// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "edge/image/patch.h"

namespace plumbline::image {

// Features of one photo: places in full-resolution pixels, descriptors of unit length in columns.
struct Features {
  std::vector<Eigen::Vector2d> place_px;
  Eigen::MatrixXf descriptors;  // 128 x count
};

// The strongest SIFT features (Lowe 2004) of the photo at about a megapixel, spread over the photo.
Features detect_features(const PhotoLevels& photo, int wanted);

// Pairs of indices (first, second): each the other's best, and clearly better than the second best.
std::vector<std::pair<int, int>> match_features(const Features& first, const Features& second);

}  // namespace plumbline::image
