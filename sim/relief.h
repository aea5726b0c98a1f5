// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace plumbline::sim {

// A box standing on the ground: a container, a crate.
struct Box {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();  // east, north
  Eigen::Vector2d half_size_m = Eigen::Vector2d::Ones();
  double turn_rad = 0;
  double height_m = 1;
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(128);  // red, green, blue, 0..255

  // Distance to the nearest side, negative inside, metres.
  double outside_m(const Eigen::Vector2d& place_m) const;
};

// A cone of gravel with a rounded top and foot.
struct Heap {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double radius_m = 5;
  double height_m = 2.5;
};

// A straight dam: flat crown, even slopes.
struct Embankment {
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();     // on its axis
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // of its axis
  double crown_half_width_m = 1;
  double slope = 0.5;  // height over width
  double height_m = 1.8;
};

// What stands on the hills.
struct Features {
  std::vector<Box> boxes;
  std::vector<Heap> heaps;
  std::vector<Embankment> embankments;

  // Height of heaps and embankments above the hills, metres.
  double raised_m(const Eigen::Vector2d& place_m) const;
  const Box* box_at(const Eigen::Vector2d& place_m, double margin_m) const;  // null: none
};

// Places them around the foot of the climb (0, 0), which stays free; distances are multiplied by
// `spread` (1: a heap at some 20 m, an embankment at some 30 m), sizes are not.
Features random_features(std::uint64_t seed, double spread);

}  // namespace plumbline::sim
