// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/paper/stages.h"
#include "edge/orient/problem.h"

namespace plumbline::orient::paper {

// Stage 1. `length` must be seen whole in every photo; a sentence says where it is not.
Result<Heights> heights_from(const Problem& problem, const Length& length);

}  // namespace plumbline::orient::paper
