// SPDX-License-Identifier: MIT
#pragma once

#include "edge/geometry/camera.h"

namespace plumbline::ingest {

// The camera to start from where nothing tells more: what drones' cameras have, with wide sigmas.
geometry::Camera usual_lens(int width_px, int height_px);

// Likewise, of a known focal length and its relative sigma.
geometry::Camera usual_lens(int width_px, int height_px, double focal_length_px,
                            double focal_sigma);

}  // namespace plumbline::ingest
