// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network/network.h"

namespace plumbline::orient {

// Of three stations that contradict each other nothing tells which is wrong.
inline constexpr int kLeastStations = 4;

// Zero where it is not known: a delay then does not move the station.
Eigen::Vector3d velocity_in_enu_m_s(const Network& network, int slot);

// By how much, east, north and up, the station would be off for a delay that is off by its sigma.
Eigen::Vector3d shift_by_delay_sigma_m(const Network& network, int slot);

// Weights of the stations in the robust stage (Cauchy over each 3-vector), and the weight of one
// that lies so many sigmas off.
double station_weight_at(double sigmas);
std::vector<double> robust_station_weights(const Network& network, const State& state);

}  // namespace plumbline::orient
