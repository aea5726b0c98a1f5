// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "edge/geometry/camera.h"
#include "firmware/config/config.h"

namespace plumbline::service {

// What is wrong where the pictures are of another size than those of the calibration: as
// configured, or as the rows of the camera's frames tell. Nothing would be measured with it. Empty
// where they agree as far as is known.
std::optional<std::string> other_size(const config::CameraConfig& config,
                                      const geometry::Camera& calibrated,
                                      std::optional<int> rows_seen = {});

}  // namespace plumbline::service
