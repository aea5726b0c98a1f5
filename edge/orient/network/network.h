// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/base/index.h"
#include "edge/orient/problem.h"

namespace plumbline::orient {

// Columns that all photos share: the ten of geometry::Interior, then two that tie time to space.
enum SharedColumn {
  kLineTime = geometry::kInteriorCount,  // of the rolling shutter, seconds per row
  kDelay,                                // of the exposures behind the stations' clock, seconds
  kShared
};
using SharedVector = Eigen::Matrix<double, kShared, 1>;

// One image ray that the adjustment works with.
struct Ray {
  int slot = 0;   // photo, counted among those that are oriented
  int point = 0;  // as in Problem::point_names
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 1;  // current; estimated groups are rescaled as the adjustment learns
  ImageGroup group = ImageGroup::kTies;
  int observation = 0;  // index in Problem::observations
  bool used = true;     // false: rejected as a blunder
  // What the camera's centre moves by per second of line time: its velocity times the rows from
  // the middle one, for which the pose is, to the one measured. Zero where no velocity is known.
  Eigen::Vector3d centre_by_line_time_m_s = Eigen::Vector3d::Zero();
};

// The values of all unknowns.
struct State {
  geometry::InteriorVector interior = geometry::InteriorVector::Zero();
  std::vector<geometry::Pose> poses;    // by slot
  std::vector<Eigen::Vector3d> points;  // by point
  double line_time_s = 0;               // seconds per row
  double delay_s = 0;

  // Where the camera was when it took the row of `ray`.
  Eigen::Vector3d centre_of(const Ray& ray) const {
    return poses[at(ray.slot)].centre_m + line_time_s * ray.centre_by_line_time_m_s;
  }
};

// Columns of the reduced system: shared (12), photos (centre 3, rotation increment 3), then
// the points that other terms couple ("kept": those of lengths and control). All other points are
// eliminated one by one.
struct Layout {
  int slots = 0;
  std::vector<int> kept;           // point by kept index
  std::vector<int> kept_of_point;  // -1: eliminated

  static constexpr int kPose = 6;
  int photo(int slot) const { return kShared + kPose * slot; }
  int kept_point(int kept_index) const { return photo(slots) + 3 * kept_index; }
  int columns() const { return kept_point(static_cast<int>(kept.size())); }
};

// Points that the same photos see, used or not: their equations have the same columns.
struct PointGroup {
  std::vector<int>
      slots;  // of each point's rays, in their order; twice where a photo sees it twice
  std::vector<int> points;  // ascending
  bool kept = false;        // they are columns of the reduced system
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
  std::vector<PointGroup> groups;  // of the points that have rays
  // 1 for a parameter that is adjusted, 0 for one that is held fixed.
  SharedVector shared_mask = SharedVector::Ones();

  const Photo& photo(int slot) const {
    return problem->photos[static_cast<std::size_t>(photo_of_slot[static_cast<std::size_t>(slot)])];
  }
  int slots() const { return layout.slots; }
  int points() const { return static_cast<int>(first_ray.size()) - 1; }
  // Unknowns of the reduced system: its columns without those held fixed.
  int adjusted_columns() const {
    return layout.columns() - static_cast<int>((shared_mask.array() == 0).count());
  }
};

// The network of the photos given by `photo_of_slot`. Observations of other photos are left out.
Network make_network(const Problem& problem, std::vector<int> photo_of_slot);

// The mask of what a problem leaves free: whatever has a prior sigma.
SharedVector shared_mask_of(const Problem& problem);

// The sigma of an image observation before anything was learnt from residuals.
double first_sigma(const Observation& observation);

// Rays of a point that are still used.
int used_rays(const Network& network, int point);

// The median height of the stations above the median height of the measured points.
double flying_height(const Network& network, const State& state);

}  // namespace plumbline::orient
