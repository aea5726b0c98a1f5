// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/paper/priors.h"
#include "edge/orient/paper/stages.h"
#include "edge/orient/problem.h"

namespace plumbline::orient::paper {

// Stage 2. As printed, the determinants of eq. 3 are summed without weights, which has a false
// minimum at a camera of infinite size and lets far points count 200 times as much as near ones;
// here each condition is divided by what image noise does to it (Sampson 1982; the Gauss-Helmert
// model of Mikhail 1976), damped (Marquardt 1963), and held by the priors. `camera` has its prior
// sigmas.
Result<RelativeOrientation> relative_orientation(const Problem& problem,
                                                 const geometry::Camera& camera,
                                                 const Heights& heights, const Length& length,
                                                 const Priors& priors);

}  // namespace plumbline::orient::paper
