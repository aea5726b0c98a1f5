// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/findings/solution_of.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// `straight`: the frame of the straight covariance.
// Says in the summary, and of each station in its photo, what was found to be wrong and what
// nothing checks. Needs the residuals of `solution` and its oriented photos.
void add_findings(const Finished& finished, const LocalFrameFit& straight, Solution& solution);

}  // namespace plumbline::orient
