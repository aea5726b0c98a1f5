// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"
#include "edge/orient/precision/covariance.h"

namespace plumbline::orient {

// An error bar is straight, and a climb that knows its azimuth or its level to a degree is not:
// points turn along arcs, and what images allow for is no parabola. The directions in which the
// photos are known worst are followed to both sides, everything else adjusted to each place, and
// the covariance along them is replaced by the second moments, about the estimate, of what was
// found there, weighted by its likelihood (Gauss-Hermite quadrature of five nodes, Abramowitz and
// Stegun 1964, 25.4.46; profile likelihood). What two of them move together beyond what
// each moves alone is added, and so are what each of them moves the points by together with the
// directions known well, the turn of each point's own error with its photos and an allowance for
// what the next order would add. Where all is known well the covariance comes back as
// it was. `state` is the minimum of the plain adjustment of `terms`.
NetworkCovariance bent_covariance(const Network& network, const State& state, const State& datum,
                                  const TermOptions& terms, const NetworkCovariance& linear);

}  // namespace plumbline::orient
