// SPDX-License-Identifier: MIT
#include "sim/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/random.h"

namespace plumbline::sim {
namespace {

constexpr std::uint64_t kFeatureStream = 0xFEA7;

// max(x, 0) with a rounded corner of width `soft`.
double softly_positive(double x, double soft) {
  if (x <= -soft) return 0;
  if (x >= soft) return x;
  return (x + soft) * (x + soft) / (4 * soft);
}

// min(x, limit) with a rounded corner.
double softly_limited(double x, double limit, double soft) {
  return limit - softly_positive(limit - x, soft);
}

double heap_height_m(const Heap& heap, const Eigen::Vector2d& place_m) {
  const double distance_m = (place_m - heap.centre_m).norm();
  const double flank_m = heap.height_m * (1 - distance_m / heap.radius_m);
  return softly_positive(softly_limited(flank_m, 0.9 * heap.height_m, 0.4), 0.15);
}

double embankment_height_m(const Embankment& dam, const Eigen::Vector2d& place_m) {
  const Eigen::Vector2d from_axis = place_m - dam.point_m;
  const double across_m =
      std::abs(from_axis.x() * dam.direction.y() - from_axis.y() * dam.direction.x());
  const double flank_m = dam.height_m - dam.slope * (across_m - dam.crown_half_width_m);
  return softly_positive(softly_limited(flank_m, dam.height_m, 0.05), 0.1);
}

Eigen::Vector2d at_bearing(double distance_m, double bearing_rad) {
  return {distance_m * std::sin(bearing_rad), distance_m * std::cos(bearing_rad)};
}

Box random_box(Random& random, double bearing_rad, double spread, bool container) {
  Box box;
  box.centre_m = at_bearing(spread * random.uniform(11, 26), bearing_rad);
  box.turn_rad = random.uniform(0, std::numbers::pi);
  const Eigen::Vector2d crate_m(random.uniform(0.5, 1.0), random.uniform(0.6, 1.4));
  box.half_size_m = container ? Eigen::Vector2d(1.22, 3.03) : crate_m;
  box.height_m = container ? 2.59 : random.uniform(0.6, 1.5);
  const auto grey = static_cast<float>(random.uniform(120, 185));
  box.colour = container ? Eigen::Vector3f(66, 98, 128) : Eigen::Vector3f(grey, grey, 0.92f * grey);
  return box;
}

}  // namespace

double Box::outside_m(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d from_centre = place_m - centre_m;
  const double c = std::cos(turn_rad);
  const double s = std::sin(turn_rad);
  const Eigen::Vector2d along(c * from_centre.x() + s * from_centre.y(),
                              c * from_centre.y() - s * from_centre.x());
  return (along.cwiseAbs() - half_size_m).maxCoeff();
}

double Features::raised_m(const Eigen::Vector2d& place_m) const {
  double sum_m = 0;
  for (const Heap& heap : heaps) sum_m += heap_height_m(heap, place_m);
  for (const Embankment& dam : embankments) sum_m += embankment_height_m(dam, place_m);
  return sum_m;
}

const Box* Features::box_at(const Eigen::Vector2d& place_m, double margin_m) const {
  const auto hit = std::find_if(boxes.begin(), boxes.end(),
                                [&](const Box& box) { return box.outside_m(place_m) <= margin_m; });
  return hit == boxes.end() ? nullptr : &*hit;
}

Features random_features(std::uint64_t seed, double spread) {
  Random random(seed, kFeatureStream);
  const double first_rad = random.uniform(0, 2 * std::numbers::pi);
  const auto bearing = [&](double part) {
    return first_rad + 2 * std::numbers::pi * (part + random.uniform(-0.04, 0.04));
  };
  Features features;
  features.heaps.push_back({at_bearing(spread * random.uniform(17, 22), bearing(0.10)),
                            random.uniform(4.0, 5.5), random.uniform(2.2, 3.0)});
  features.heaps.push_back({at_bearing(spread * random.uniform(14, 24), bearing(0.55)),
                            random.uniform(2.0, 3.0), random.uniform(0.9, 1.4)});
  Embankment dam;
  const double across_rad = bearing(0.32);
  dam.point_m = at_bearing(spread * random.uniform(29, 34), across_rad);
  dam.direction = at_bearing(1, across_rad + std::numbers::pi / 2);
  dam.height_m = random.uniform(1.4, 2.0);
  features.embankments.push_back(dam);
  features.boxes.push_back(random_box(random, bearing(0.45), spread, true));
  for (const double part : {0.0, 0.2, 0.65, 0.75, 0.9}) {
    features.boxes.push_back(random_box(random, bearing(part), spread, false));
  }
  return features;
}

}  // namespace plumbline::sim
