// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/network/terms.h"
#include "edge/orient/precision/covariance.h"

namespace plumbline::orient {

// The covariance without the information that the errors of the points feign. What tells a focal
// length or a tilt from photos of nearly flat ground is the relief, and measured relief is rougher
// than the ground by its own errors: E[S(x + u)] = S(x) + E[S'' u u] / 2, whose last term is taken
// off the reduced matrix S by central differences, which leaves A, what the cost truly curves by
// (corrected score, Nakamura 1990). The residuals are independent of the adjusted points, so S is
// the variance of the cost's slope all the same, and the covariance is A^-1 S A^-1 (Huber 1967).
// Never less variance than `straight`, nor more than sixteen times as much.
NetworkCovariance without_borrowed(const Network& network, const State& state, const State& datum,
                                   const TermOptions& terms, const NetworkCovariance& straight);

}  // namespace plumbline::orient
