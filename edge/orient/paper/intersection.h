// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/paper/heights.h"
#include "edge/orient/paper/priors.h"
#include "edge/orient/paper/stages.h"

namespace plumbline::orient::paper {

// Stage 3: every point from all its rays by the collinearity equations, eq. 5, with the transpose
// that the printed matrix lacks (it is the one of eq. 3, which turns image into ground, while eq. 5
// turns ground into image). Points near the axis of the climb have no height of their own: the
// ground is a plane, with each point flat to Priors::ground_flat_m about it. Fails where a point
// falls behind a photo.
Result<Intersection> intersect(const Problem& problem, const Heights& heights,
                               const RelativeOrientation& relative, const Priors& priors);

}  // namespace plumbline::orient::paper
