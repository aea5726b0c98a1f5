// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/geometry/camera.h"
#include "edge/plan/flight.h"
#include "edge/plan/options.h"

namespace plumbline::plan {

// Distances from the foot of the climb, metres.
struct Ring {
  double from_m = 0;
  double to_m = 0;
};

// Up to ten rings of one neat width (1, 2, 2.5 or 5 times a power of ten) within the radius that
// matters; the last may be narrower where the radius was given.
std::vector<Ring> rings_of(const Flight& flight, const Options& options);

// A point on the ground stands for `ties` points around it: that much does it weigh in the
// adjustment. Points in rings are there to be looked at, and weigh next to nothing.
struct GroundPoint {
  Eigen::Vector3d in_enu_m;
  double ties = 1;
  int ring = -1;  // in which its sigma counts; -1: none
};

// How many points stand for the ties.
enum class Detail {
  kRepresentative,  // some hundreds, whatever the number of ties
  kAll,             // every tie for itself, up to what a second allows
};

// The foot first, then 16 points per ring, then an even spread over the ground where ties lie.
std::vector<GroundPoint> ground_points(const Flight& flight,
                                       const std::vector<geometry::Pose>& poses,
                                       const std::vector<Ring>& rings, const Options& options,
                                       Detail detail);

// Height of the ground, about 0 on the mean.
double ground_height_m(const Eigen::Vector2d& from_foot_m, const Options& options);

bool sees(const geometry::Camera& camera, const geometry::Pose& pose, const Eigen::Vector3d& point);

}  // namespace plumbline::plan
