// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/paper/stages.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"

namespace plumbline::orient::paper {

// Stage 4: the model in metres and in the frame of the three points. Fails where those are on one
// line.
Result<ScaledModel> scaled_model(const Problem& problem, const RelativeOrientation& relative,
                                 const Intersection& intersection, const Length& length,
                                 const FrameRoles& roles);

}  // namespace plumbline::orient::paper
