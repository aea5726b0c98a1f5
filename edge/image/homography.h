// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "edge/image/patch.h"

namespace plumbline::image {

// A point of one photo and the same point in another, in pixels.
struct Correspondence {
  Eigen::Vector2d first_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d second_px = Eigen::Vector2d::Zero();
};

Eigen::Vector2d transform(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel);

// The map near `pixel`: the homography's value and first derivatives.
LocalMap local_map(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel);

// Least-squares homography of four or more correspondences by the normalised direct linear
// transform (Hartley and Zisserman 2004, algorithm 4.2). Nothing where they do not determine one.
std::optional<Eigen::Matrix3d> fit_homography(const std::vector<Correspondence>& points);

struct HomographyConsensus {
  Eigen::Matrix3d second_from_first = Eigen::Matrix3d::Identity();
  std::vector<int> inliers;  // indices of the correspondences
};

// Random sample consensus (Fischler and Bolles 1981) with its own generator seeded by `seed`;
// only homographies possible between downward photos of scale ratio up to 4 are considered.
std::optional<HomographyConsensus> find_homography(const std::vector<Correspondence>& points,
                                                   double tolerance_px, std::uint64_t seed);

}  // namespace plumbline::image
