// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/covariance.h"
#include "edge/orient/network.h"
#include "edge/orient/terms.h"

namespace plumbline::orient {

// Weights of the stations in the robust stage (Cauchy over each 3-vector).
std::vector<double> robust_station_weights(const Network& network, const State& state);

// The station whose residual disagrees most with what the rest predicts, by the chi-square test of
// its 3-vector at 0.1 % (1 % in a flight of ten photos); -1 where none does. Directions in which
// the rest cannot check it do not count (Baarda 1968).
int suspicious_station(const Network& network, const State& state, const TermOptions& options,
                       const std::vector<Term>& terms, const NetworkCovariance& covariance);

}  // namespace plumbline::orient
