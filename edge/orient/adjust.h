// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/options.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// One robust adjustment of everything known, each with its sigma. Needs no starting values.
// Pure: the same problem gives the same bits. Fails with a sentence where there is no solution.
Result<Solution> adjust(const Problem& problem, const Options& options);

}  // namespace plumbline::orient
