// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/geometry/camera.h"

namespace plumbline::orient::paper {

// What the published procedure does not declare, but cannot converge without: weak knowledge that
// any user has of a drone's camera over a field. All are standard deviations.
struct Priors {
  double ground_flat_m = 0.3;     // of each height about the X-Y plane of the frame
  double tilt_deg = 5;            // of each tilt about the normal of that plane
  double focal_length = 0.01;     // relative
  double principal_point = 0.01;  // of the photo's width
  double affinity = 2e-3;         // and skew (a1, a2 of eq. 4)
  double radial = 0.05;           // k1, k2, k3
  double tangential = 5e-3;       // p1, p2
  double held_m = 3e-3;           // the coordinates that define the frame
};

// The camera with these priors wherever it does not know better itself.
geometry::Camera camera_with(const Priors& priors, const geometry::Camera& camera);

// "ground flat to 0.3 m, f to 1 %, ...": as used with this camera.
std::string in_words(const Priors& priors, const geometry::Camera& camera);

}  // namespace plumbline::orient::paper
