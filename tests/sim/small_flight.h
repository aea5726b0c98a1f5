// SPDX-License-Identifier: MIT
#pragma once

#include "sim/flight.h"

namespace plumbline::sim {

// A low climb with a small camera, quick to render: discs are some 36 px wide.
inline Profile small_profile() {
  Profile profile;
  profile.from_m = 12;
  profile.to_m = 16;
  profile.step_m = 2;
  profile.side_steps_m = {2};
  profile.width_px = 640;
  profile.height_px = 480;
  profile.focal_length_px = 500;
  profile.radial = {-0.05, 0.02, 0};
  profile.tangential = {1e-3, -8e-4};
  profile.tilt_sigma_deg = 2;
  profile.target_diameter_m = 0.8;
  profile.targets = 12;
  return profile;
}

}  // namespace plumbline::sim
