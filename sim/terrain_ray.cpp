// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "sim/terrain.h"

// Where a ray meets the ground. On gentle ground the fixed point z = height(place of the ray at z)
// is unique and the secant method finds it; near steep sides the ray is followed from above.

namespace plumbline::sim {
namespace {

constexpr double kCoarseCell_m = 1.0;
constexpr double kSteepSlope =
    0.45;  // rays of 60 degrees off the vertical still meet once below it
constexpr double kSteepReach_m = 5.0;
constexpr double kTolerance_m = 2e-5;  // of a halving
constexpr double kLastStep_m = 4e-4;   // of the secant: what remains is a tenth of it or less

double east(const Terrain::Ray& ray, double z) {
  return ray.east_at_zero_m + z * ray.east_per_metre;
}
double north(const Terrain::Ray& ray, double z) {
  return ray.north_at_zero_m + z * ray.north_per_metre;
}

}  // namespace

int Terrain::coarse_index(double east_m, double north_m) const {
  const auto part = [&](double m) {
    return std::clamp(static_cast<int>((m + half_extent_m_) / kCoarseCell_m), 0, coarse_side_ - 1);
  };
  return part(north_m) * coarse_side_ + part(east_m);
}

void Terrain::finish() {
  coarse_side_ = static_cast<int>(std::ceil(2 * half_extent_m_ / kCoarseCell_m));
  highest_m_ = *std::max_element(heights_.values.begin(), heights_.values.end());
  find_highest_nearby();
  find_steep();
}

void Terrain::find_highest_nearby() {
  highest_nearby_m_.assign(
      static_cast<std::size_t>(coarse_side_) * static_cast<std::size_t>(coarse_side_), -1e9f);
  for (int y = 0; y < heights_.side; ++y) {
    for (int x = 0; x < heights_.side; ++x) {
      const double e = x * cell_m_ - half_extent_m_;
      const double n = y * cell_m_ - half_extent_m_;
      for (const double de : {-kCoarseCell_m, kCoarseCell_m}) {
        for (const double dn : {-kCoarseCell_m, kCoarseCell_m}) {
          float& highest =
              highest_nearby_m_[static_cast<std::size_t>(coarse_index(e + de, n + dn))];
          highest = std::max(highest, heights_.at(x, y));
        }
      }
      float& own = highest_nearby_m_[static_cast<std::size_t>(coarse_index(e, n))];
      own = std::max(own, heights_.at(x, y));
    }
  }
}

void Terrain::find_steep() {
  steep_.assign(highest_nearby_m_.size(), 0);
  const auto limit = static_cast<float>(kSteepSlope * cell_m_);
  for (int y = 0; y + 1 < heights_.side; ++y) {
    for (int x = 0; x + 1 < heights_.side; ++x) {
      const float here = heights_.at(x, y);
      if (std::abs(heights_.at(x + 1, y) - here) <= limit &&
          std::abs(heights_.at(x, y + 1) - here) <= limit) {
        continue;
      }
      const double e = x * cell_m_ - half_extent_m_;
      const double n = y * cell_m_ - half_extent_m_;
      steep_[static_cast<std::size_t>(coarse_index(e, n))] = 2;
    }
  }
  const int reach = static_cast<int>(kSteepReach_m / kCoarseCell_m);
  for (int y = 0; y < coarse_side_; ++y) {
    for (int x = 0; x < coarse_side_; ++x) {
      if (steep_[static_cast<std::size_t>(y * coarse_side_ + x)] != 2) continue;
      for (int v = std::max(0, y - reach); v <= std::min(coarse_side_ - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(coarse_side_ - 1, x + reach); ++u) {
          std::uint8_t& flag = steep_[static_cast<std::size_t>(v * coarse_side_ + u)];
          flag = std::max<std::uint8_t>(flag, 1);
        }
      }
    }
  }
}

bool Terrain::may_be_shaded(const Eigen::Vector2d& place_m) const {
  return steep_[static_cast<std::size_t>(coarse_index(place_m.x(), place_m.y()))] != 0;
}

double Terrain::meet(const Ray& ray, double guess_m) const {
  const auto place = coarse_index(east(ray, guess_m), north(ray, guess_m));
  if (steep_[static_cast<std::size_t>(place)] != 0) return march(ray);
  double z0 = guess_m;
  double f0 = height_m(east(ray, z0), north(ray, z0)) - z0;
  double z1 = z0 + f0;
  for (int k = 0; k < 12 && std::abs(z1 - z0) > kLastStep_m; ++k) {
    const double f1 = height_m(east(ray, z1), north(ray, z1)) - z1;
    const double fall = (f1 - f0) / (z1 - z0);  // -1 on level ground
    const double next = z1 - f1 / std::min(fall, -0.3);
    z0 = z1;
    f0 = f1;
    z1 = next;
  }
  return z1;
}

double Terrain::march(const Ray& ray) const {
  const double sideways = std::max(std::hypot(ray.east_per_metre, ray.north_per_metre), 1e-3);
  // A corner cut shorter than this may be missed: less than a pixel of a photo.
  const double fine_m = std::min(0.3 * cell_m_ / sideways, 2.0);
  const double coarse_m = std::min(0.5 * kCoarseCell_m / sideways, 2.0);
  double above_m = highest_m_ + 0.01;
  const double lowest_m = above_m - 1000;
  while (above_m > lowest_m) {
    const int place = coarse_index(east(ray, above_m), north(ray, above_m));
    const double clear_m = above_m - highest_nearby_m_[static_cast<std::size_t>(place)];
    const double next_m = above_m - (clear_m > 0 ? std::min(coarse_m, clear_m + fine_m) : fine_m);
    if (height_m(east(ray, next_m), north(ray, next_m)) >= next_m) {
      return bisect(ray, above_m, next_m);
    }
    above_m = next_m;
  }
  return lowest_m;
}

double Terrain::bisect(const Ray& ray, double above_m, double below_m) const {
  while (above_m - below_m > kTolerance_m) {
    const double middle_m = 0.5 * (above_m + below_m);
    const bool under = height_m(east(ray, middle_m), north(ray, middle_m)) >= middle_m;
    (under ? below_m : above_m) = middle_m;
  }
  return 0.5 * (above_m + below_m);
}

}  // namespace plumbline::sim
