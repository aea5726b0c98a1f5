// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::orient {

// Moves a free network onto what is known: stations, control, lengths, headings. A similarity
// (shift, scale, azimuth) with a small tilt, least squares for each azimuth of a full circle of
// trials, the best of which wins: stations nearly on one line have several near-best azimuths, and
// a descent from the wrong side of the circle would stay there. A wrong station among good ones is
// outweighed (Cauchy). What nothing fixes stays as it is.
State aligned(const Network& network, const State& free, const TermOptions& options);

// The same for `count` azimuths all around the circle, one network for each: for descents that
// must not miss the right one.
std::vector<State> aligned_all_around(const Network& network, const State& free,
                                      const TermOptions& options, int count);

// An aligned network as the priors alone would have it: photos on their stations, looking straight
// down (or as their attitude is given) with the azimuths of `aligned`, all points on flat ground. A
// free network of two or three photos may have gone to the wrong side of a valley; this one has
// been nowhere.
State levelled(const Network& network, const State& aligned, const TermOptions& options);

}  // namespace plumbline::orient
