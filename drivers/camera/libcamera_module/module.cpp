// SPDX-License-Identifier: MIT
#include <string>

#include "drivers/camera/camera_module.h"
#include "drivers/camera/libcamera_module/libcamera_camera.h"

namespace {

plumbline::Camera* make(const char* id, const plumbline::Clock* clock) {
  return new plumbline::LibcameraCamera(id, *clock);
}

void list(void* context, void (*found)(void* context, const char* id)) {
  for (const auto& camera : plumbline::camera_manager().cameras()) {
    found(context, camera->id().c_str());
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const PlumblineCameraModule*
plumbline_camera_module() {
  static const std::string version = plumbline::compat::version_text();
  static const PlumblineCameraModule module = {
      plumbline::kCameraModuleAbi, plumbline::module_sizes(), version.c_str(), make, list};
  return &module;
}
