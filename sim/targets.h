// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/terrain.h"

namespace plumbline::sim {

// A target: a round black plate with a white disc, flat on the ground. Its coordinates are those
// of the disc's centre.
struct Target {
  std::string name;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  // local ENU
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();     // of its plane: d height / d (east, north)
  double disc_radius_m = 0.2;

  double plate_radius_m() const { return 1.7 * disc_radius_m; }
  // Distance from the centre within the plate's plane, of the point of the plane at this place.
  double radius_at_m(const Eigen::Vector2d& place_m) const;
};

struct TargetOptions {
  int count = 39;
  double disc_radius_m = 0.2;
  // Half sizes of the field they are spread over, east and north of the foot of the climb; an
  // ellipse. The nearest share of them fills the middle, for photos from low heights.
  Eigen::Vector2d field_m = {20, 30};
  double lowest_to_highest = 1;  // flying heights: the field shrinks by it for the nearest targets
  std::uint64_t seed = 1;
};

// Presses the plates into the terrain, P01, P02, ..., clear of each other, of boxes, and of steep
// ground. Fewer than asked for where the field is too small to hold them.
std::vector<Target> lay_targets(const TargetOptions& options, Terrain& terrain);

}  // namespace plumbline::sim
