// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/network/network.h"

namespace plumbline::orient {

// Why what is left of a network determines no solution, and what to look at: as far as its rays
// tell, in one sentence.
Error no_solution(const Network& network, const State& state);

// Rays of points that two photos see and that are determined by their rays: how many there are, and
// how many were not set aside.
struct Agreement {
  int rays = 0;
  int used = 0;
  // No robust estimate stands on a minority; one in four may agree on anything.
  bool is_minority() const { return 2 * used < rays; }
  bool is_chance() const { return 4 * used < rays; }
};
Agreement agreement(const Network& network);

// The error of an agreement by chance.
Error contradiction(const Network& network);

}  // namespace plumbline::orient
