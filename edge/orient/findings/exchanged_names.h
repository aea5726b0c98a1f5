// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/findings/solution_of.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// Two names of points that stand for each other: in one photo (both measurements were rejected, and
// each fits the other's point), or in the control (both were rejected, and each fits the other's
// place). Said, not mended: nothing of it was used.
std::vector<Blunder> exchanged_names(const Finished& finished);

}  // namespace plumbline::orient
