// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/network.h"

namespace plumbline::orient {

// Why what is left of a network determines no solution, and what to look at: as far as its rays
// tell, in one sentence.
Error no_solution(const Network& network, const State& state);

}  // namespace plumbline::orient
