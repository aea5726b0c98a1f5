// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::orient {

struct MinimiseOptions {
  double cauchy_scale = 0;  // of image rays, in sigmas; 0 = plain least squares
  int max_iterations = 100;
  // A step that lowers the cost by less than this share (or by nothing to speak of), nearly
  // undamped, is the last one.
  double tolerance = 1e-10;
};

struct Minimum {
  State state;
  double cost = 0;  // sum of weighted squared residuals, robustified where asked for
  int iterations = 0;
  bool converged = false;
};

// Levenberg-Marquardt from `state` to the nearest minimum (Levenberg 1944, Marquardt 1963).
// `start`: what the datum terms hold on to.
Minimum minimise(const Network& network, const State& state, const State& start,
                 const TermOptions& terms, const MinimiseOptions& options);

}  // namespace plumbline::orient
