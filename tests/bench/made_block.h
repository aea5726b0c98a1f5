// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network/minimise.h"
#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::bench {

// A problem with a start near its truth: what both sides of a comparison are given.
struct MadeBlock {
  orient::Problem problem;
  orient::State start;
  orient::TermOptions terms;
};

// A climb from 70 m to 90 m in four photos with a side-step of 10 m at its top, over `points`
// points; all ten interior parameters are adjusted, each with a prior sigma.
MadeBlock made_climb(int points);

// 60 photos at 70 m, 80 % overlap along six strips and 60 % across, over `points` points, nine of
// them control.
MadeBlock made_grid(int points);

// The network of all photos of `block`, which must outlive it.
orient::Network network_of(const MadeBlock& block);

// Plain least squares from the block's start. `settled` is what the prior on the azimuth, which
// nobody knows, holds on to: where it is the minimum itself, that prior pulls at nothing.
orient::Minimum minimum_of(const MadeBlock& block, const orient::Network& network,
                           const orient::State& settled);

}  // namespace plumbline::bench
