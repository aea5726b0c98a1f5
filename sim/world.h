// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "edge/base/image.h"
#include "sim/ground_texture.h"
#include "sim/targets.h"
#include "sim/terrain.h"

namespace plumbline::sim {

struct WorldOptions {
  double half_extent_m = 125;
  double relief = 1;  // factor on all heights of the ground
  TargetOptions targets;
  double photo_texel_m = 0.02;
  std::uint64_t seed = 1;
  int threads = 1;
};

// The ground below a climb: its shape, its colour in sunlight, and the targets on it. Local ENU,
// the origin on the ground at the foot of the climb. Immutable once made.
class World {
 public:
  // `ground_photo`: a photo (3 channels) as ground texture instead of the painted one.
  World(const WorldOptions& options, const std::optional<Image>& ground_photo);

  const Terrain& terrain() const { return terrain_; }
  const std::vector<Target>& targets() const { return targets_; }

  // Colour of the ground, red green blue 0..255, in sunlight.
  Eigen::Vector3f colour(double east_m, double north_m, const Footprint& footprint) const;

 private:
  struct Cell {  // what lies in a square of ground; -1: nothing
    std::int16_t target = -1;
    std::int16_t box = -1;
  };
  void note_cells();
  void shine(int threads);
  float light(double east_m, double north_m) const;
  float target_light(const Target& target) const;
  const Cell& cell(double east_m, double north_m) const;
  Eigen::Vector3f ground_colour(const Cell& cell, double east_m, double north_m,
                                const Footprint& footprint) const;

  Terrain terrain_;
  std::vector<Target> targets_;
  GroundTexture texture_;
  std::vector<Cell> cells_;
  int cells_side_ = 0;
  Grid light_;  // 1: level ground in the sun
  double light_cells_per_metre_ = 10;
};

}  // namespace plumbline::sim
