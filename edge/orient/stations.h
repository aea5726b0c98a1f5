// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network.h"

namespace plumbline::orient {

// Of three stations that contradict each other nothing tells which is wrong.
inline constexpr int kLeastStations = 4;

// Weights of the stations in the robust stage (Cauchy over each 3-vector), and the weight of one
// that lies so many sigmas off.
double station_weight_at(double sigmas);
std::vector<double> robust_station_weights(const Network& network, const State& state);

}  // namespace plumbline::orient
