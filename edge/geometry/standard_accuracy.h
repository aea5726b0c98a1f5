// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace plumbline::geometry {

// What image noise alone makes of a ground point, by formulas of one line: a yardstick beside an
// adjustment, which knows the rest (orientation, camera, positions).

struct StandardAccuracy {
  double plan_m = 0;  // sigma of each horizontal axis
  double height_m = 0;
};

// Kunii and Kumazaki 2018, eq. 6, for two photos side by side ("standard accuracy"):
//   sigma_xy = H/f sigma_p,   sigma_z = sqrt(2) H/f H/B sigma_p
// H flying height and B base in metres, f in pixels, sigma_p of an image coordinate in pixels.
// All must be positive; with B = 0 the height is infinite.
StandardAccuracy standard_accuracy(double flying_height_m, double base_m, double focal_length_px,
                                   double sigma_px);

// Height from a vertical climb, where eq. 6 does not hold since the base points at the ground: the
// distance r of a point from the foot appears as f r / (H_i - Z) in photo i, and least squares
// over all photos, with r unknown as well, leaves
//   sigma_z = sigma_p H^3 / (f r sqrt(sum (H_i - H)^2)),   H the mean of the heights H_i.
// First order in (H_i - H) / H. Infinite at the foot (r = 0) and for a single height.
double climb_height_accuracy_m(const std::vector<double>& heights_m, double distance_from_foot_m,
                               double focal_length_px, double sigma_px);

}  // namespace plumbline::geometry
