// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "drivers/camera.h"
#include "edge/base/result.h"

namespace plumbline {

// The mode to stream in. Without wishes: the largest size; of the formats that it comes in one that
// reaches 10 frames a second (else the fastest), colour before grey, uncompressed before JPEG,
// finished before Bayer. Of raw frames that with the most bits. A size that is in no mode but lies
// within them is tried with the camera, which may take any: the driver checks what it got. Fails
// with the list of what there is.
Result<CameraMode> choose_mode(const std::vector<CameraMode>& modes, const CameraOptions& options);

// "1920 x 1080 YUYV, 1280 x 720 MJPG ...", largest first, a few.
std::string text_of(const std::vector<CameraMode>& modes);

}  // namespace plumbline
