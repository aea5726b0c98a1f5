// SPDX-License-Identifier: MIT
#include "sim/world.h"

#include <algorithm>
#include <cmath>

#include "edge/base/parallel.h"

namespace plumbline::sim {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kBoxPaintMargin_m = 0.12;  // the sides are painted like the top
constexpr float kWhite = 232;
constexpr float kBlack = 26;
// The sun stands in the south-east, 50 degrees high.
const Eigen::Vector3d kToSun = Eigen::Vector3d(0.4545, -0.4545, 0.7660).normalized();
constexpr float kSky = 0.45f;  // share of the light that comes from everywhere
constexpr double kShadowReach_m = 6;

// The height grid is fine enough for targets, and not larger than memory bears.
double terrain_cell_m(double half_extent_m) { return std::max(0.1, half_extent_m / 2000); }
double paint_texel_m(double half_extent_m) { return std::max(0.05, half_extent_m / 3000); }

TerrainOptions terrain_options(const WorldOptions& options) {
  const double spread = std::min(1.0, options.half_extent_m / 60);
  return {options.half_extent_m, terrain_cell_m(options.half_extent_m),
          options.relief,        spread,
          options.seed,          options.threads};
}

TextureOptions texture_options(const WorldOptions& options) {
  return {options.half_extent_m, paint_texel_m(options.half_extent_m), options.photo_texel_m,
          options.seed, options.threads};
}

// Lambert's cosine law for the sun, plus the sky; 1 on level ground.
float lit(const Eigen::Vector2d& slope, bool in_sun) {
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
  const double sun = in_sun ? std::max(0.0, normal.dot(kToSun)) / kToSun.z() : 0.0;
  return kSky + (1 - kSky) * static_cast<float>(std::min(sun, 1.45));
}

// How much of a sample `footprint_m` wide lies within `radius_m`, its middle at `at_m`.
float covered(double radius_m, double at_m, double footprint_m) {
  return static_cast<float>(std::clamp((radius_m - at_m) / footprint_m + 0.5, 0.0, 1.0));
}

}  // namespace

World::World(const WorldOptions& options, const std::optional<Image>& ground_photo)
    : terrain_(terrain_options(options)),
      targets_(lay_targets(options.targets, terrain_)),
      texture_(texture_options(options), ground_photo) {
  terrain_.finish();
  note_cells();
  shine(options.threads);
}

const World::Cell& World::cell(double east_m, double north_m) const {
  const auto part = [&](double m) {
    const int index = static_cast<int>((m + terrain_.half_extent_m()) / kCell_m);
    return static_cast<std::size_t>(std::clamp(index, 0, cells_side_ - 1));
  };
  return cells_[part(north_m) * static_cast<std::size_t>(cells_side_) + part(east_m)];
}

void World::note_cells() {
  cells_side_ = static_cast<int>(std::ceil(2 * terrain_.half_extent_m() / kCell_m));
  cells_.assign(static_cast<std::size_t>(cells_side_) * static_cast<std::size_t>(cells_side_), {});
  const double half_diagonal_m = kCell_m * 0.7072;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const int x = static_cast<int>(k) % cells_side_;
    const int y = static_cast<int>(k) / cells_side_;
    const Eigen::Vector2d middle_m = Eigen::Vector2d(x + 0.5, y + 0.5) * kCell_m -
                                     Eigen::Vector2d::Constant(terrain_.half_extent_m());
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const double reach_m = targets_[t].plate_radius_m() + 0.1 + half_diagonal_m;
      const Eigen::Vector2d target_m = targets_[t].centre_m.head<2>();
      if ((middle_m - target_m).norm() < reach_m) cells_[k].target = static_cast<std::int16_t>(t);
    }
    const Box* box = terrain_.features().box_at(middle_m, kBoxPaintMargin_m + half_diagonal_m);
    if (box == nullptr) continue;
    cells_[k].box = static_cast<std::int16_t>(box - terrain_.features().boxes.data());
  }
}

void World::shine(int threads) {
  const double light_cell_m = terrain_.cell_m();
  light_cells_per_metre_ = 1 / light_cell_m;
  const double half_m = terrain_.half_extent_m();
  light_.side = static_cast<int>(2 * half_m / light_cell_m);
  light_.values.resize(static_cast<std::size_t>(light_.side) *
                       static_cast<std::size_t>(light_.side));
  parallel_for(light_.side, threads, [&](int y) {
    for (int x = 0; x < light_.side; ++x) {
      const Eigen::Vector2d place_m(x * light_cell_m - half_m, y * light_cell_m - half_m);
      bool in_sun = true;
      if (terrain_.may_be_shaded(place_m)) {
        const double height_m = terrain_.height_m(place_m.x(), place_m.y()) + 0.02;
        for (double up_m = 0.08; up_m < kShadowReach_m && in_sun; up_m += 0.08) {
          const Eigen::Vector3d on_way = kToSun * (up_m / kToSun.z());
          in_sun = terrain_.height_m(place_m.x() + on_way.x(), place_m.y() + on_way.y()) <
                   height_m + up_m;
        }
      }
      light_.at(x, y) = lit(terrain_.slope(place_m, light_cell_m), in_sun);
    }
  });
}

float World::light(double east_m, double north_m) const {
  const double limit = light_.side - 1.001;
  const double x =
      std::clamp((east_m + terrain_.half_extent_m()) * light_cells_per_metre_, 0.0, limit);
  const double y =
      std::clamp((north_m + terrain_.half_extent_m()) * light_cells_per_metre_, 0.0, limit);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const auto a = static_cast<float>(x - i);
  const auto b = static_cast<float>(y - j);
  return (1 - b) * ((1 - a) * light_.at(i, j) + a * light_.at(i + 1, j)) +
         b * ((1 - a) * light_.at(i, j + 1) + a * light_.at(i + 1, j + 1));
}

float World::target_light(const Target& target) const { return lit(target.slope, true); }

Eigen::Vector3f World::ground_colour(const Cell& cell, double east_m, double north_m,
                                     const Footprint& footprint) const {
  const Eigen::Vector2d place_m(east_m, north_m);
  if (cell.box >= 0) {
    const Box& box = terrain_.features().boxes[static_cast<std::size_t>(cell.box)];
    if (box.outside_m(place_m) <= kBoxPaintMargin_m) {
      const float worn = texture_.detail(east_m, north_m, footprint);
      return box.colour * (1 + 0.3f * worn) * light(east_m, north_m);
    }
  }
  return texture_.colour(east_m, north_m, footprint) * light(east_m, north_m);
}

Eigen::Vector3f World::colour(double east_m, double north_m, const Footprint& footprint) const {
  const Cell& here = cell(east_m, north_m);
  if (here.target < 0) return ground_colour(here, east_m, north_m, footprint);
  const Target& target = targets_[static_cast<std::size_t>(here.target)];
  const double radius_m = target.radius_at_m({east_m, north_m});
  const float plate = covered(target.plate_radius_m(), radius_m, footprint.metres);
  if (plate <= 0) return ground_colour(here, east_m, north_m, footprint);
  const float disc = covered(target.disc_radius_m, radius_m, footprint.metres);
  const float grey = (kBlack + disc * (kWhite - kBlack)) * target_light(target);
  const Eigen::Vector3f painted = Eigen::Vector3f::Constant(grey);
  if (plate >= 1) return painted;
  return plate * painted + (1 - plate) * ground_colour(here, east_m, north_m, footprint);
}

}  // namespace plumbline::sim
