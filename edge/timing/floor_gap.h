// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace plumbline::timing {

// How far below the lowest of some delays their law begins, seconds.
struct FloorGap {
  double mean_s = 0;
  double sigma_s = 0;
};

// The posterior of that distance. Just above its beginning a law rises as some power k of the
// distance (k = 1: exponential and uniform; 2: two such waits in a row; 3: Weibull's and gamma's of
// that shape; below 1: laws that crowd at their floor), which is the domain of attraction of
// Weibull's extreme-value law (Gnedenko 1943). Given the highest of the points that are looked at,
// L above the floor, the others are then independent with density k y^(k-1) / L^k (Hall 1982, "On
// estimating the endpoint of a distribution"). With a gamma prior k is integrated out in closed
// form; the distance is by numerical integration. An unknown k makes the sigma as wide as it is:
// what begins thinly says little about where.
//
// `above_s`: distances of the lowest points from the lowest of all, ascending, the first one 0; at
// least one. Those far from the floor say nothing about it and should not be among them.
FloorGap floor_gap(std::span<const double> above_s);

}  // namespace plumbline::timing
