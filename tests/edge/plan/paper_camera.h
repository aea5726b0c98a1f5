// SPDX-License-Identifier: MIT
#pragma once

#include "edge/plan/options.h"

namespace plumbline::plan::testing {

// The camera of Kunii and Kumazaki 2018, calibrated: f and principal point to 0.5 px, distortion to
// 2e-4.
inline geometry::Camera paper_camera() {
  geometry::Camera camera;
  camera.width_px = 4000;
  camera.height_px = 2250;
  camera.interior << 2125, 1999.5, 1124.5, 0, 0, 0, 0, 0, 0, 0;
  camera.sigma << 0.5, 0.5, 0.5, 0, 0, 2e-4, 2e-4, 0, 2e-4, 2e-4;
  return camera;
}

inline Options paper_options(double sigma_px) {
  Options options;
  options.camera = paper_camera();
  options.sigma_px = sigma_px;
  options.rtk = Rtk{};
  return options;
}

}  // namespace plumbline::plan::testing
