// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "drivers/camera/libcamera_module/libcamera_compat.h"

namespace plumbline {

std::optional<PixelFormat> pixel_format_of(const libcamera::PixelFormat& format);

// The modes of a configuration: of stills the sensor's full size is among them.
std::vector<CameraMode> modes_of(const libcamera::CameraConfiguration& configuration);

// Those of stills and those of raw frames, each once: most pipelines offer Bayer only as the
// latter.
std::vector<CameraMode> modes_of(libcamera::Camera& camera);

// What to ask libcamera for: stills, unless raw frames are wanted and may be had. May be nullptr.
std::unique_ptr<libcamera::CameraConfiguration> configuration_for(libcamera::Camera& camera,
                                                                  const CameraOptions& options);

// What is set before the first frame, and what cannot be had.
struct LibcameraSettings {
  libcamera::ControlList controls{libcamera::controls::controls};
  std::vector<std::string> notices;
};
LibcameraSettings settings_for(const libcamera::Camera& camera, const CameraOptions& options,
                               std::optional<double> lens_position);

// A new bound on exposure, in the manner of the settings above. False where the gain, which nobody
// fixed, cannot follow the light with it.
bool set_exposure(const libcamera::ControlInfoMap& offered, const CameraOptions& options,
                  libcamera::ControlList& controls);

std::vector<CameraControl> describe_controls(const libcamera::ControlInfoMap& offered);

std::string model_of(const libcamera::Camera& camera);

}  // namespace plumbline
