// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "edge/orient/paper/priors.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"

namespace plumbline::orient::testing {

// Table 2 of Kunii and Kumazaki 2018 prints attitudes as 6' 58": minutes and seconds of arc, or,
// meant so, degrees and minutes.
enum class AttitudeReading { kMinutesSeconds, kDegreesMinutes };

// The experiment of the paper on a field like its own: 39 targets over 40 m by 55 m about the
// stations of Table 2, all seen in all five photos; No. 27 at the origin, No. 35 on the X axis at
// 14.831 m, No. 62 in the X-Y plane. Where the others lie the paper does not print.
struct FieldPlan {
  AttitudeReading reading = AttitudeReading::kMinutesSeconds;
  double image_sigma_px = 0.5;
  double relief_m = 0.26;  // RMS of Z in the frame: what "everything is flat" scores
  double wave_m = 9;       // of the relief: its waves are 2 pi times as long
  int targets = 39;
  paper::Priors priors;  // the true camera is spread about the nominal one by these
};

struct TestField {
  Problem problem;  // observations, the nominal camera, and the known length; nothing else
  FrameRoles roles;
  std::vector<geometry::Pose> poses;
  std::vector<Eigen::Vector3d> points;
  geometry::InteriorVector interior;
};

// Truth plus noise. The true camera differs from the nominal one (f 2125 px, principal point in the
// middle, no distortion) by the spread of paper::Priors.
TestField make_test_field(const FieldPlan& plan, std::uint64_t seed);

}  // namespace plumbline::orient::testing
