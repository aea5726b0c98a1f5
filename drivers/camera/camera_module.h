// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "drivers/clock.h"
#include "edge/base/result.h"

// The libcamera driver is a shared object of its own, because each libcamera 0.x is an incompatible
// soname: only the module must be rebuilt for another one, and where it is missing everything else
// works. Module and program are built from the same sources; the ABI version and the sizes of what
// crosses between them are checked when it is loaded.
extern "C" {

struct PlumblineCameraModule {
  std::uint32_t abi_version;
  std::uint32_t sizes;    // plumbline::module_sizes()
  const char* libcamera;  // "0.0.3", which it was built for and runs with
  // A camera for an id that list() names, or that may come; never nullptr. To be deleted, before
  // the clock is.
  plumbline::Camera* (*make)(const char* id, const plumbline::Clock* clock);
  // Calls `found` with the id of each camera that there is.
  void (*list)(void* context, void (*found)(void* context, const char* id));
};

// Exported by the module under this name; nullptr never.
using PlumblineCameraModuleEntry = const PlumblineCameraModule* (*)();
}

namespace plumbline {

inline constexpr std::uint32_t kCameraModuleAbi = 2;
inline constexpr const char* kCameraModuleEntry = "plumbline_camera_module";
inline constexpr const char* kCameraModuleFile = "plumbline_libcamera.so";

// Of the types of the seam, so that a module of older sources is noticed.
constexpr std::uint32_t module_sizes() {
  return static_cast<std::uint32_t>(sizeof(CameraOptions) * 65536 + sizeof(CameraEvent) * 256 +
                                    sizeof(CameraDescription));
}

// A loaded module; it stays loaded until the process ends, because threads of libcamera run in it.
class CameraModule {
 public:
  // Looks in `folders`, in order, for the module's file. The error says what is missing: the
  // module, the libcamera that it was built for, or a rebuild.
  static Result<CameraModule> load(const std::vector<std::string>& folders);

  // `clock` outlives the camera; it is that by which the kernel stamps frames (CLOCK_MONOTONIC).
  std::unique_ptr<Camera> make(const std::string& id, const Clock& clock) const;
  std::vector<std::string> list() const;
  std::string libcamera_version() const { return module_->libcamera; }

 private:
  explicit CameraModule(const PlumblineCameraModule* module) : module_(module) {}

  const PlumblineCameraModule* module_;
};

// Where it is looked for: beside the running program (a build folder), then where it is installed.
std::vector<std::string> camera_module_folders();

}  // namespace plumbline
