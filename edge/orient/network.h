// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/base/index.h"
#include "edge/orient/problem.h"

namespace plumbline::orient {

// One image ray that the adjustment works with.
struct Ray {
  int slot = 0;   // photo, counted among those that are oriented
  int point = 0;  // as in Problem::point_names
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 1;  // current; estimated groups are rescaled as the adjustment learns
  ImageGroup group = ImageGroup::kTies;
  int observation = 0;  // index in Problem::observations
  bool used = true;     // false: rejected as a blunder
};

// The values of all unknowns.
struct State {
  geometry::InteriorVector interior = geometry::InteriorVector::Zero();
  std::vector<geometry::Pose> poses;    // by slot
  std::vector<Eigen::Vector3d> points;  // by point
};

// Columns of the reduced system: interior (10), photos (centre 3, rotation increment 3), then
// the points that other terms couple ("kept": those of lengths and control). All other points are
// eliminated one by one.
struct Layout {
  int slots = 0;
  std::vector<int> kept;           // point by kept index
  std::vector<int> kept_of_point;  // -1: eliminated

  static constexpr int kPose = 6;
  int photo(int slot) const { return geometry::kInteriorCount + kPose * slot; }
  int kept_point(int kept_index) const { return photo(slots) + 3 * kept_index; }
  int columns() const { return kept_point(static_cast<int>(kept.size())); }
};

// The part of a problem that can be adjusted: photos that are tied together, and rays sorted by
// point.
struct Network {
  const Problem* problem = nullptr;
  std::vector<int> photo_of_slot;
  std::vector<int> slot_of_photo;  // -1: not tied to the others
  std::vector<Ray> rays;           // sorted by point, then slot
  std::vector<int> first_ray;      // of point p: rays [first_ray[p], first_ray[p + 1])
  // By point: its rays meet at so small an angle that its distance is anyone's guess.
  std::vector<bool> undetermined;
  // By which the variance of ties grows for what neighbouring ones share.
  double ties_design_effect = 1;
  Layout layout;
  // 1 for a parameter that is adjusted, 0 for one that is held fixed.
  geometry::InteriorVector interior_mask = geometry::InteriorVector::Ones();

  const Photo& photo(int slot) const {
    return problem->photos[static_cast<std::size_t>(photo_of_slot[static_cast<std::size_t>(slot)])];
  }
  int slots() const { return layout.slots; }
  int points() const { return static_cast<int>(first_ray.size()) - 1; }
};

// The network of the photos given by `photo_of_slot`. Observations of other photos are left out.
Network make_network(const Problem& problem, std::vector<int> photo_of_slot);

// Rays of a point that are still used.
int used_rays(const Network& network, int point);

}  // namespace plumbline::orient
