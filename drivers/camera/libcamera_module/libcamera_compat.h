// SPDX-License-Identifier: MIT
#pragma once

#include <libcamera/libcamera.h>
#include <libcamera/version.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// Everything in which libcamera 0.0.3 (Debian 12), 0.4 (Debian 13) and later (Raspberry Pi OS)
// differ for us. Elsewhere in this folder only what they have in common is used.
namespace plumbline::compat {

inline constexpr int kVersion =
    LIBCAMERA_VERSION_MAJOR * 10000 + LIBCAMERA_VERSION_MINOR * 100 + LIBCAMERA_VERSION_PATCH;

inline std::string version_text() {
  return std::to_string(LIBCAMERA_VERSION_MAJOR) + "." + std::to_string(LIBCAMERA_VERSION_MINOR) +
         "." + std::to_string(LIBCAMERA_VERSION_PATCH);
}

// Bounds of a control that the camera has, else nullptr. (count() of 0.0.3 counts the controls that
// libcamera knows, not those that the camera has.)
inline const libcamera::ControlInfo* offered(const libcamera::ControlInfoMap& controls,
                                             const libcamera::ControlId& id) {
  const auto at = controls.find(id.id());
  return at == controls.end() ? nullptr : &at->second;
}

// Roles were a vector until 0.1, a span since.
inline std::unique_ptr<libcamera::CameraConfiguration> configuration_for(
    libcamera::Camera& camera, libcamera::StreamRole role) {
  const std::vector<libcamera::StreamRole> roles{role};
  return camera.generateConfiguration(roles);
}

// Exposure held while gain goes on to follow the light. Since 0.5 each has a mode of its own;
// before, pipelines with an exposure algorithm (AeExposureMode tells them) took a fixed
// ExposureTime while AeEnable stays on, and others had one switch for both. False: the latter.
inline bool hold_exposure_only(const libcamera::ControlInfoMap& has,
                               libcamera::ControlList& controls) {
#if LIBCAMERA_VERSION_MAJOR > 0 || LIBCAMERA_VERSION_MINOR >= 5
  if (offered(has, libcamera::controls::ExposureTimeMode) != nullptr &&
      offered(has, libcamera::controls::AnalogueGainMode) != nullptr) {
    controls.set(libcamera::controls::ExposureTimeMode,
                 libcamera::controls::ExposureTimeModeManual);
    controls.set(libcamera::controls::AnalogueGainMode, libcamera::controls::AnalogueGainModeAuto);
    return true;
  }
#endif
  if (offered(has, libcamera::controls::AeExposureMode) == nullptr) return false;
  controls.set(libcamera::controls::AeEnable, true);
  return true;
}

// High dynamic range merges exposures of different times.
inline void turn_off_hdr(const libcamera::ControlInfoMap& has, libcamera::ControlList& controls) {
#if LIBCAMERA_VERSION_MAJOR > 0 || LIBCAMERA_VERSION_MINOR >= 2
  if (offered(has, libcamera::controls::HdrMode) != nullptr) {
    controls.set(libcamera::controls::HdrMode, libcamera::controls::HdrModeOff);
  }
#else
  static_cast<void>(has);
  static_cast<void>(controls);
#endif
}

// From the first row's exposure to the last row's.
inline std::optional<std::int64_t> rolling_shutter_skew_ns(const libcamera::ControlList& metadata) {
  return metadata.get(libcamera::controls::draft::SensorRollingShutterSkew);
}

}  // namespace plumbline::compat
