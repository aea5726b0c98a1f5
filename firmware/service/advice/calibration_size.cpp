// SPDX-License-Identifier: MIT
#include "firmware/service/advice/calibration_size.h"

namespace plumbline::service {

std::optional<std::string> other_size(const config::CameraConfig& config,
                                      const geometry::Camera& calibrated,
                                      std::optional<int> rows_seen) {
  const std::optional<int> width_px = config.options.width_px;
  const std::optional<int> height_px = rows_seen ? rows_seen : config.options.height_px;
  std::string found;
  if (width_px && *width_px != calibrated.width_px) {
    found = "they are " + std::to_string(*width_px) + " pixels wide";
  } else if (height_px && *height_px != calibrated.height_px) {
    found = "they are " + std::to_string(*height_px) + " pixels high";
  }
  if (found.empty()) return std::nullopt;
  return "camera.calibration " + config.calibration + " is for pictures of " +
         std::to_string(calibrated.width_px) + " x " + std::to_string(calibrated.height_px) +
         " pixels, and " + found +
         ": no flight can be measured with it. Set camera.width_px and camera.height_px to its "
         "size, or calibrate the camera at this one.";
}

}  // namespace plumbline::service
