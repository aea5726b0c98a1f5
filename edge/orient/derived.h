// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/base/result.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// A figure computed from measured points, with its sigma from their joint covariance (first order:
// J C J').
struct Derived {
  double value = 0;
  double sigma = 0;
  Eigen::VectorXd jacobian;  // by the coordinates of the points, in their order
};

// Of two points, in space; m.
Result<Derived> distance(const Solution& solution, int a, int b);

// Of the polygon with these corners, seen from above (the surveyor's area, by the shoelace
// formula; C. F. Gauss, A. L. F. Meister 1769), whichever way round; m2. At least three corners; an
// error where its sides cross.
Result<Derived> area(const Solution& solution, const std::vector<int>& corners);

// Between the level `level_m` and the surface of triangles over these corners: prisms of the
// triangles that cutting ears makes of the polygon (G. H. Meisters 1975); what lies below the level
// counts as negative; m3.
Result<Derived> volume(const Solution& solution, const std::vector<int>& corners, double level_m);

}  // namespace plumbline::orient
