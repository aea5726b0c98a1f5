// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/fractal.h"
#include "sim/relief.h"

namespace plumbline::sim {

struct TerrainOptions {
  double half_extent_m = 125;  // the world reaches this far east, west, north and south of (0, 0)
  double cell_m = 0.1;         // spacing of the height grid
  double relief = 1;           // factor on hills, heaps and embankments; 0: a plain
  double spread = 1;           // factor on the distance of heaps, embankments and boxes
  std::uint64_t seed = 1;
  int threads = 1;
};

// The ground: height over (east, north), local ENU, metres; bilinear in a grid, so that a plane is
// a plane exactly. Height 0 is the ground at the foot of the climb, (0, 0).
class Terrain {
 public:
  explicit Terrain(const TerrainOptions& options);

  double cell_m() const { return cell_m_; }
  double half_extent_m() const { return half_extent_m_; }
  double highest_m() const { return highest_m_; }
  const Features& features() const { return features_; }

  double height_m(double east_m, double north_m) const;
  // (d height / d east, d height / d north) over +-`reach_m`.
  Eigen::Vector2d slope(const Eigen::Vector2d& place_m, double reach_m) const;

  // Presses a flat round plate into the ground: its plane through the ground at `centre_m` with
  // `slope`, exact within `radius_m`, running out into the ground around it.
  void press_plate(const Eigen::Vector2d& centre_m, const Eigen::Vector2d& slope, double radius_m);

  // Must be called after the last plate and before meet(): finds where the ground is steep.
  void finish();

  // After finish(): whether something steep stands near enough to cast a shadow here.
  bool may_be_shaded(const Eigen::Vector2d& place_m) const;

  // A ray that runs down: at height z it is over (at_zero_m + z * per_metre).
  struct Ray {
    double east_at_zero_m = 0;
    double north_at_zero_m = 0;
    double east_per_metre = 0;
    double north_per_metre = 0;
  };
  // The height at which a ray from above first meets the ground, to 40 micrometres.
  // `guess_m`: a height of the ground nearby; it decides the speed, not the result.
  double meet(const Ray& ray, double guess_m) const;

 private:
  void raise_features(double relief, int threads);
  void put_foot_at_zero();
  void find_highest_nearby();
  void find_steep();
  int coarse_index(double east_m, double north_m) const;
  double march(const Ray& ray) const;
  double bisect(const Ray& ray, double above_m, double below_m) const;

  double cell_m_;
  double cells_per_metre_;
  double half_extent_m_;
  double highest_m_ = 0;
  Features features_;
  Grid heights_;
  int coarse_side_ = 0;
  std::vector<float> highest_nearby_m_;  // per coarse cell, its neighbours included
  std::vector<std::uint8_t> steep_;      // per coarse cell: slopes nearby may hide ground
};

}  // namespace plumbline::sim
