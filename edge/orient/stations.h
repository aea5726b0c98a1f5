// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network.h"

namespace plumbline::orient {

// Weights of the stations in the robust stage (Cauchy over each 3-vector).
std::vector<double> robust_station_weights(const Network& network, const State& state);

}  // namespace plumbline::orient
