// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::orient {

// Adds what holds the network where nothing known does (inner constraints on the stations), and a
// uniform prior on the azimuth where something does.
void add_datum_terms(const Network& network, const State& state, const State& start,
                     const TermOptions& options, std::vector<Term>& terms);

}  // namespace plumbline::orient
