// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/findings/solution_of.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// Of all observations, as Problem::observations: residual, redundancy and w test; the rejected ones
// against what the rest predicts.
std::vector<ObservationResidual> observation_residuals(const Finished& finished);

}  // namespace plumbline::orient
