// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "edge/base/image.h"
#include "edge/geometry/camera.h"
#include "sim/world.h"

namespace plumbline::sim {

struct SensorOptions {
  double blur_sigma_px = 0.5;       // of the lens; sampling adds about 0.3 px in quadrature
  double motion_blur_px = 0;        // length of the streak
  double motion_direction_rad = 0;  // from +u towards +v
  // Variance of the noise in grey levels squared: read + shot * grey level.
  double read_variance = 1.0;
  double shot_variance = 0.013;
  double vignetting = 0.18;  // share of the light lost in the corners
};

// The photo that `camera` takes of `world`, by ray casting; 3 channels. Pixels are projected by
// ray_in_photo of `camera.interior`, inverted on a lattice of 4 px and interpolated in between
// (to 1e-3 px for distortions of 100 px). `seed` is that of the sensor's noise: the same photo for
// any number of threads.
Image render(const World& world, const geometry::Camera& camera, const geometry::Pose& pose,
             const SensorOptions& sensor, std::uint64_t seed, int threads);

}  // namespace plumbline::sim
