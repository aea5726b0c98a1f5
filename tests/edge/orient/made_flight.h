// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "edge/orient/adjust.h"

namespace plumbline::orient::testing {

// The flight of papers and README: a climb over a field of targets, seen by the paper's camera.
struct FlightPlan {
  std::vector<double> heights_m = {70, 75, 80, 85, 90};
  double side_step_m = 10;  // one more photo at the top, so far east; 0 = none
  int targets = 39;
  double image_sigma_px = 0.3;
  double rtk_sigma_horizontal_m = 0.005;
  double rtk_sigma_vertical_m = 0.010;
  double tilt_sigma_deg = 1.0;
  double drift_m = 0.7;  // bowed, over the climb
  double relief_m = 1.5;
  double gross_share = 0;  // of observations, 5 to 300 px off
  bool stations = true;
  double heading_sigma_deg = 0;  // 0: no heading given
  ImageGroup group = ImageGroup::kStated;
};

struct MadeFlight {
  Problem problem;
  std::vector<geometry::Pose> poses;
  std::vector<Eigen::Vector3d> points;
  geometry::InteriorVector interior;
};

// Truth plus noise, the camera as calibrated among it (f 0.5 px, principal point 0.5 px,
// distortion 2e-4).
MadeFlight make_flight(const FlightPlan& plan, std::uint64_t seed);

}  // namespace plumbline::orient::testing
