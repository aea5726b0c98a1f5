// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/result.h"
#include "edge/orient/adjust.h"
#include "edge/orient/paper/priors.h"
#include "edge/orient/paper/stages.h"

namespace plumbline::orient::paper {

// What stages 5 and 6 adjust: the observations and the known length in the frame, nothing else.
struct FramedCase {
  const Problem& given;
  geometry::Camera camera;  // with its prior sigmas
  Length length;
  FrameRoles roles;
  Priors priors;
};

// Stage 5: all photos and the camera by collinearity, with the points held as control.
Adjusted resect(const FramedCase& framed, const RelativeOrientation& relative,
                const ScaledModel& model);

struct FinalAdjustment {
  Adjusted stage;
  Solution solution;  // in the frame of the roles, with its covariance
};

// Stage 6: everything unknown at once. The paper does not state the datum: the frame's six
// coordinates are held, the length gives the scale, and every height is flat within the prior.
Result<FinalAdjustment> adjust_all(const FramedCase& framed, const Adjusted& start,
                                   const Options& options);

}  // namespace plumbline::orient::paper
