// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/precision/covariance.h"
#include "edge/orient/precision/weak_directions.h"

namespace plumbline::orient {

// What a weak direction of the photos and one of `others` move each point by beyond what each of
// them moves it: the mixed second derivative of the point that its rays give, for one sigma of
// either. The others may be known so well that no image tells, but depths hang on them by a hundred
// times as much, and by how much depends on where the weak direction has led: to another foot of
// the climb, or along other rays. `one_sigma` is the step along the weak direction, whose sigma is
// `sigma_rad`; `covariance` is the straight one. Steps of the points alone, and only those that
// matter beside a point's own errors.
std::vector<Step> point_twists(const Network& network, const State& state,
                               const NetworkCovariance& covariance, const Step& one_sigma,
                               double sigma_rad, const std::vector<WeakDirection>& others);

}  // namespace plumbline::orient
