// SPDX-License-Identifier: MIT
#include "sim/targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim/random.h"

namespace plumbline::sim {
namespace {

constexpr std::uint64_t kTargetStream = 0x7A26;
constexpr double kSteepestPlate = 0.3;
constexpr double kBoxClearance_m = 2.5;  // no target in a box's shadow
constexpr int kTries = 400;

std::string target_name(std::size_t index) {
  char text[32];
  std::snprintf(text, sizeof text, "P%02zu", index + 1);
  return text;
}

// Even over the ellipse; where the climb spans a range of heights, half of the targets are drawn
// at a size of the field between those of the lowest and the highest photo.
Eigen::Vector2d random_place(const TargetOptions& options, Random& random) {
  const double bearing_rad = random.uniform(0, 2 * std::numbers::pi);
  const double size =
      random.uniform() < 0.5 ? 1.0 : std::pow(options.lowest_to_highest, random.uniform());
  const double radius = size * std::sqrt(random.uniform());
  return radius * options.field_m.cwiseProduct(
                      Eigen::Vector2d(std::sin(bearing_rad), std::cos(bearing_rad)));
}

bool is_clear(const std::vector<Target>& laid, const Eigen::Vector2d& place_m, double radius_m,
              const Terrain& terrain) {
  if (terrain.features().box_at(place_m, radius_m + kBoxClearance_m) != nullptr) return false;
  if (terrain.slope(place_m, 0.5).norm() > kSteepestPlate) return false;
  return std::none_of(laid.begin(), laid.end(), [&](const Target& other) {
    return (other.centre_m.head<2>() - place_m).norm() < 2 * radius_m + 1.5;
  });
}

}  // namespace

double Target::radius_at_m(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d across = place_m - centre_m.head<2>();
  return std::hypot(across.x(), across.y(), slope.dot(across));
}

std::vector<Target> lay_targets(const TargetOptions& options, Terrain& terrain) {
  Random random(options.seed, kTargetStream);
  std::vector<Target> laid;
  for (int k = 0; k < options.count; ++k) {
    for (int trial = 0; trial < kTries; ++trial) {
      Target target;
      target.disc_radius_m = options.disc_radius_m;
      const Eigen::Vector2d place_m = random_place(options, random);
      if (!is_clear(laid, place_m, target.plate_radius_m(), terrain)) continue;
      target.name = target_name(laid.size());
      target.slope = terrain.slope(place_m, 0.5);
      target.centre_m << place_m, terrain.height_m(place_m.x(), place_m.y());
      terrain.press_plate(place_m, target.slope, target.plate_radius_m());
      laid.push_back(target);
      break;
    }
  }
  return laid;
}

}  // namespace plumbline::sim
