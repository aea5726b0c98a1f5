// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/geometry/standard_accuracy.h"
#include "edge/orient/adjust.h"
#include "edge/orient/paper/priors.h"
#include "edge/orient/paper/stages.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"

namespace plumbline::orient::paper {

// The published procedure (Y. Kunii and R. Kumazaki 2018, "Development of photogrammetric method
// using vertical image by UAV"), stage by stage: ground coordinates from a vertical climb, with
// nothing known but one length. As printed it does not converge; here the same stages have weights,
// damping and declared weak priors, which carry the heights: those near the foot of the climb are
// no better than "the ground is flat".
struct Procedure {
  Priors priors;
  std::string declared;  // the priors in words
  Heights heights;
  RelativeOrientation relative;
  Intersection intersection;
  ScaledModel model;
  Adjusted resection;
  Adjusted adjusted;
  // Eq. 6 with the mean height H and the longest base B of the final stations, for one pixel as in
  // the paper.
  double mean_height_m = 0;
  double longest_base_m = 0;
  geometry::StandardAccuracy standard;
  Solution solution;  // in the frame of `roles`
};

// Of everything in `problem` only the camera, the observations and the first length are used.
// `options`: what the solution calls unobservable. Pure; a sentence where it cannot be done.
Result<Procedure> run_procedure(const Problem& problem, const FrameRoles& roles,
                                const Priors& priors, const Options& options);

}  // namespace plumbline::orient::paper
