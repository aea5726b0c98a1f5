// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/covariance.h"
#include "edge/orient/terms.h"

namespace plumbline::orient {

// The covariance without the information that the errors of the points feign. What tells a focal
// length or a tilt from photos of nearly flat ground is the relief, and measured relief is rougher
// than the ground by its own errors: E[S(x + u)] = S(x) + E[S'' u u] / 2, whose last term is taken
// off the reduced matrix by central differences (corrected score, Nakamura 1990). Never less
// variance than `straight`, nor more than four times as much.
NetworkCovariance without_borrowed(const Network& network, const State& state, const State& datum,
                                   const TermOptions& terms, const NetworkCovariance& straight);

}  // namespace plumbline::orient
