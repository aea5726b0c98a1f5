// SPDX-License-Identifier: MIT
#include "edge/geometry/standard_accuracy.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace plumbline::geometry {

StandardAccuracy standard_accuracy(double flying_height_m, double base_m, double focal_length_px,
                                   double sigma_px) {
  const double pixel_on_ground_m = flying_height_m / focal_length_px;
  StandardAccuracy out;
  out.plan_m = pixel_on_ground_m * sigma_px;
  out.height_m = std::numbers::sqrt2 * pixel_on_ground_m * (flying_height_m / base_m) * sigma_px;
  return out;
}

double climb_height_accuracy_m(const std::vector<double>& heights_m, double distance_from_foot_m,
                               double focal_length_px, double sigma_px) {
  if (heights_m.empty()) return std::numeric_limits<double>::infinity();
  const double mean = std::accumulate(heights_m.begin(), heights_m.end(), 0.0) /
                      static_cast<double>(heights_m.size());
  double squares = 0;
  for (const double height : heights_m) squares += (height - mean) * (height - mean);
  const double lever = focal_length_px * std::abs(distance_from_foot_m) * std::sqrt(squares);
  if (!(lever > 0)) return std::numeric_limits<double>::infinity();
  return sigma_px * mean * mean * mean / lever;
}

}  // namespace plumbline::geometry
