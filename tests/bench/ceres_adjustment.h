// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "tests/edge/orient/made_flight.h"

namespace plumbline::bench {

// The unknowns of a bundle adjustment as Ceres wants them.
struct CeresState {
  std::array<double, geometry::kInteriorCount> interior{};
  std::vector<std::array<double, 6>> photos;  // omega, phi, kappa (rad), east, north, up (m)
  std::vector<std::array<double, 3>> points;  // east, north, up (m)
};

// Near the truth: photos 1 m and 0.5 degrees off, points 1 m, the camera as calibrated.
CeresState start_near_truth(const orient::testing::MadeFlight& flight);

// The yardstick: the flight's reprojections, stations, camera priors and tilt priors as plain least
// squares, one thread, automatic derivatives, DENSE_SCHUR. No robust stage, no covariance. True
// where it converged.
bool solve_with_ceres(const orient::Problem& problem, double tilt_sigma_rad, CeresState& state);

}  // namespace plumbline::bench
