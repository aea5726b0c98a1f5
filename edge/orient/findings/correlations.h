// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/findings/diagnosis.h"

namespace plumbline::orient {

// Pairs of camera parameters and of what is common to the whole that the data cannot tell apart:
// correlated by more than `least`, the strongest first. Quantities: the interior parameters that
// were adjusted, `flying_height` (stations above the ground), `east`, `north`, `height` (of the
// points' centroid), `azimuth`, `tilt_east`, `tilt_north`, `scale`; those without any datum are
// left out.
std::vector<Correlation> correlations(const Evidence& evidence, double least);

// The combinations of camera and photos that are known worst, each named by the quantities of the
// same list that it goes with (correlation beyond 0.5).
std::vector<WeakCombination> weakest_combinations(const Evidence& evidence);

}  // namespace plumbline::orient
