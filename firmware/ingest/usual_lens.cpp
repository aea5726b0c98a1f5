// SPDX-License-Identifier: MIT
#include "firmware/ingest/usual_lens.h"

#include <algorithm>

namespace plumbline::ingest {
namespace {

// Cameras of drones see 65 to 85 degrees across: 0.55 to 0.8 of the width.
constexpr double kFocalShare = 0.7;
constexpr double kFocalSigma = 0.30;

// What is usual for lenses that are not metric (J. G. Fryer 1996, "Camera calibration", in Close
// Range Photogrammetry and Machine Vision; T. Luhmann et al. 2016, ISPRS J. 115, 37-46).
void set_sigmas(geometry::Camera& camera, double focal_sigma) {
  const double long_px = std::max(camera.width_px, camera.height_px);
  camera.sigma[geometry::kFocalLength] = focal_sigma * camera.interior[geometry::kFocalLength];
  // Sensor and lens are centred to 1 to 2 % of the side, tens of pixels.
  camera.sigma[geometry::kPrincipalU] = camera.sigma[geometry::kPrincipalV] = 0.015 * long_px;
  // Pixels are square and rows are straight to the lithography of the chip; what is left here is
  // the tilt and the shift of the optics.
  camera.sigma[geometry::kAffinity] = 5e-4;
  camera.sigma[geometry::kSkew] = 5e-4;
  // Barrel of a few per cent at the corner; what drones correct in the camera is less.
  camera.sigma[geometry::kRadial1] = 0.1;
  camera.sigma[geometry::kRadial2] = 0.1;
  // Not told from k2 by a few photos of flat ground.
  camera.sigma[geometry::kRadial3] = 0;
  // Decentring is a tenth to a hundredth of the radial part; retracting lenses show most.
  camera.sigma[geometry::kTangential1] = camera.sigma[geometry::kTangential2] = 3e-3;
}

}  // namespace

geometry::Camera usual_lens(int width_px, int height_px) {
  return usual_lens(width_px, height_px, kFocalShare * std::max(width_px, height_px), kFocalSigma);
}

geometry::Camera usual_lens(int width_px, int height_px, double focal_length_px,
                            double focal_sigma) {
  geometry::Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.interior[geometry::kFocalLength] = focal_length_px;
  camera.interior[geometry::kPrincipalU] = 0.5 * (width_px - 1);
  camera.interior[geometry::kPrincipalV] = 0.5 * (height_px - 1);
  set_sigmas(camera, focal_sigma);
  return camera;
}

}  // namespace plumbline::ingest
