// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/problem.h"

namespace plumbline::orient {

// Indices in range, all numbers finite, sigmas positive, a camera that can be one. The sentence of
// the error names the photo or point.
Status validate(const Problem& problem);

}  // namespace plumbline::orient
