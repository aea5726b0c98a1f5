// SPDX-License-Identifier: MIT
#include "sim/terrain.h"

#include <algorithm>
#include <cmath>

#include "edge/base/parallel.h"

namespace plumbline::sim {
namespace {

// Hills: amplitudes in metres of the octaves from a wavelength of 2 * 256 cells downwards.
constexpr int kOctaves = 9;
constexpr int kCellsPerLattice = 1 << (kOctaves - 1);

Grid hills(const TerrainOptions& options) {
  const double lattice_m = kCellsPerLattice * options.cell_m;
  const int lattices = static_cast<int>(std::ceil(2 * options.half_extent_m / lattice_m)) + 1;
  std::vector<double> amplitudes(kOctaves, 0.0);
  const double metres[] = {1.5, 0.6, 0.2, 0.06, 0.02};
  for (std::size_t k = 0; k < 5; ++k) amplitudes[k] = options.relief * metres[k];
  return fractal(lattices, amplitudes, options.seed ^ 0x8111u, options.threads);
}

double smooth_step(double t) {
  const double c = std::clamp(t, 0.0, 1.0);
  return c * c * (3 - 2 * c);
}

}  // namespace

Terrain::Terrain(const TerrainOptions& options)
    : cell_m_(options.cell_m),
      cells_per_metre_(1 / options.cell_m),
      half_extent_m_(options.half_extent_m),
      features_(random_features(options.seed, options.spread)),
      heights_(hills(options)) {
  put_foot_at_zero();
  raise_features(options.relief, options.threads);
}

double Terrain::height_m(double east_m, double north_m) const {
  const double limit = heights_.side - 1.001;
  const double x = std::clamp((east_m + half_extent_m_) * cells_per_metre_, 0.0, limit);
  const double y = std::clamp((north_m + half_extent_m_) * cells_per_metre_, 0.0, limit);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const double a = x - i;
  const double b = y - j;
  const float* low =
      &heights_.values[static_cast<std::size_t>(j) * static_cast<std::size_t>(heights_.side) +
                       static_cast<std::size_t>(i)];
  const float* high = low + heights_.side;
  return (1 - b) * ((1 - a) * low[0] + a * low[1]) + b * ((1 - a) * high[0] + a * high[1]);
}

Eigen::Vector2d Terrain::slope(const Eigen::Vector2d& place_m, double reach_m) const {
  const double e = place_m.x();
  const double n = place_m.y();
  return Eigen::Vector2d(height_m(e + reach_m, n) - height_m(e - reach_m, n),
                         height_m(e, n + reach_m) - height_m(e, n - reach_m)) /
         (2 * reach_m);
}

void Terrain::put_foot_at_zero() {
  const auto foot_m = static_cast<float>(height_m(0, 0));
  for (float& height : heights_.values) height -= foot_m;
}

void Terrain::raise_features(double relief, int threads) {
  std::vector<double> box_tops_m;
  for (const Box& box : features_.boxes) {
    box_tops_m.push_back(height_m(box.centre_m.x(), box.centre_m.y()) + box.height_m);
  }
  parallel_for(heights_.side, threads, [&](int y) {
    for (int x = 0; x < heights_.side; ++x) {
      const Eigen::Vector2d place_m(x * cell_m_ - half_extent_m_, y * cell_m_ - half_extent_m_);
      float& height = heights_.at(x, y);
      height += static_cast<float>(relief * features_.raised_m(place_m));
      for (std::size_t k = 0; k < features_.boxes.size(); ++k) {
        // Over one cell, so that sides that run askew to the grid are straight.
        const double inside =
            std::clamp(0.5 - features_.boxes[k].outside_m(place_m) / cell_m_, 0.0, 1.0);
        height += static_cast<float>(inside * std::max(0.0, box_tops_m[k] - height));
      }
    }
  });
}

void Terrain::press_plate(const Eigen::Vector2d& centre_m, const Eigen::Vector2d& slope,
                          double radius_m) {
  const double flat_m = radius_m + 1.5 * cell_m_;  // the cells that touch the plate are flat too
  const double outer_m = flat_m + std::max(radius_m, 5 * cell_m_);
  const double centre_height_m = height_m(centre_m.x(), centre_m.y());
  const auto index = [&](double m) {
    return std::clamp(static_cast<int>((m + half_extent_m_) / cell_m_), 0, heights_.side - 1);
  };
  for (int y = index(centre_m.y() - outer_m); y <= index(centre_m.y() + outer_m); ++y) {
    for (int x = index(centre_m.x() - outer_m); x <= index(centre_m.x() + outer_m); ++x) {
      const Eigen::Vector2d place_m(x * cell_m_ - half_extent_m_, y * cell_m_ - half_extent_m_);
      const double distance_m = (place_m - centre_m).norm();
      const double ground = smooth_step((distance_m - flat_m) / (outer_m - flat_m));
      const double plane_m = centre_height_m + slope.dot(place_m - centre_m);
      float& height = heights_.at(x, y);
      height = static_cast<float>(ground * height + (1 - ground) * plane_m);
    }
  }
}

}  // namespace plumbline::sim
