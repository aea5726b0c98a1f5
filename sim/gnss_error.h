// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/random.h"

namespace plumbline::sim {

// Standard deviations of one kind of error, metres; `horizontal_m` holds for east and for north.
struct SigmaPair {
  double horizontal_m = 0;
  double vertical_m = 0;

  Eigen::Vector3d per_axis() const { return {horizontal_m, horizontal_m, vertical_m}; }
};

// GNSS error = offset common to the flight + Gauss-Markov + white, as the adjustment models it.
struct GnssErrorSigmas {
  SigmaPair offset;
  SigmaPair correlated;
  double correlation_s = 30;  // the correlated part falls to 1/e over this time
  SigmaPair white;
};

// The errors of one flight at the times of its photos (ascending), east north up, metres.
std::vector<Eigen::Vector3d> gnss_errors(const GnssErrorSigmas& sigmas,
                                         const std::vector<double>& times_s, Random& random);

}  // namespace plumbline::sim
