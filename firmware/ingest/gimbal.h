// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "edge/orient/problem.h"
#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

struct GimbalPriors {
  std::optional<orient::AttitudePrior> attitude;  // omega and phi; kappa is left to the heading
  std::optional<orient::HeadingPrior> heading;
};

// ground_from_photo of a camera held by a gimbal at this yaw, pitch and roll (yaw 0 where empty).
Eigen::Matrix3d ground_from_photo_of(const GimbalAttitude& gimbal);

// The gimbal's word as priors: tilt to 1.5 degrees, heading (by a magnetic compass) to 5 degrees.
// Where the yaw is not said, a tilt is used only if it is less than its sigma, since its direction
// is not known. None for a camera tilted by more than 60 degrees from the vertical.
GimbalPriors gimbal_priors(const GimbalAttitude& gimbal);

}  // namespace plumbline::ingest
