// SPDX-License-Identifier: MIT
#include "firmware/devices_on_board.h"

#include <utility>

#include "drivers/camera/camera_module.h"
#include "drivers/camera/v4l2_camera.h"

namespace plumbline {
namespace {

constexpr std::string_view kLibcamera = "libcamera:";

// Loaded once; it stays loaded.
const Result<CameraModule>& camera_module() {
  static const Result<CameraModule> module = CameraModule::load(camera_module_folders());
  return module;
}

void add(Result<CameraDescription> description, const std::string& id, CamerasOnBoard& found) {
  if (!description) {
    found.remarks.push_back(description.error().sentence);
    return;
  }
  description->id = id;
  found.cameras.push_back(std::move(description).value());
}

}  // namespace

Result<std::unique_ptr<Camera>> make_camera(const std::string& id) {
  if (!id.starts_with(kLibcamera)) {
    return {std::unique_ptr<Camera>(std::make_unique<V4l2Camera>(id))};
  }
  if (!camera_module()) return camera_module().error();
  return camera_module()->make(id.substr(kLibcamera.size()));
}

CamerasOnBoard list_cameras() {
  CamerasOnBoard found;
  if (camera_module()) {
    for (const std::string& id : camera_module()->list()) {
      add(camera_module()->make(id)->describe(), std::string(kLibcamera) + id, found);
    }
  } else {
    found.remarks.push_back(camera_module().error().sentence);
  }
  for (const std::string& path : list_v4l2()) add(describe_v4l2(path), path, found);
  return found;
}

}  // namespace plumbline
