// SPDX-License-Identifier: MIT
#include "drivers/camera/camera_module.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace plumbline {
namespace {

constexpr const char* kInstalledBeside = "/../lib/plumbline";  // bin and sbin
constexpr const char* kOtherwise = "; cameras behind V4L2 work without it";

// What the loader says when a library that the module needs is not there begins with its name.
std::string why_not_loaded(const std::string& path, const std::string& loader) {
  const std::size_t colon = loader.find(": cannot open shared object file");
  const bool of_another =
      colon != std::string::npos && loader.find(kCameraModuleFile) != 0 && loader.find(path) != 0;
  if (!of_another) return "The libcamera driver '" + path + "' cannot be loaded: " + loader + ".";
  return "The libcamera driver '" + path +
         "' was built for another libcamera: " + loader.substr(0, colon) +
         " is not there. Rebuild it for the one that is installed" + kOtherwise + ".";
}

Result<const PlumblineCameraModule*> checked(void* library, const std::string& path) {
  const auto entry =
      reinterpret_cast<PlumblineCameraModuleEntry>(::dlsym(library, kCameraModuleEntry));
  if (entry == nullptr) return Error{"'" + path + "' is not the libcamera driver of plumbline."};
  const PlumblineCameraModule* module = entry();
  if (module->abi_version != kCameraModuleAbi || module->sizes != module_sizes()) {
    return Error{"The libcamera driver '" + path +
                 "' is of another version of plumbline; install or build the one that belongs to "
                 "this program" +
                 kOtherwise + "."};
  }
  return module;
}

std::string folder_of_program() {
  std::array<char, 4096> path{};
  const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size() - 1);
  const std::string program(path.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  return program.substr(0, program.rfind('/'));
}

}  // namespace

Result<CameraModule> CameraModule::load(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + kCameraModuleFile;
    if (::access(path.c_str(), F_OK) != 0) continue;
    // libcamera reads it while it is loaded; what it says below errors is of no use to a user.
    ::setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", 0);
    void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (library == nullptr) return Error{why_not_loaded(path, ::dlerror())};
    const auto module = checked(library, path);
    if (!module) return module.error();
    return CameraModule(*module);
  }
  return Error{std::string("The libcamera driver (") + kCameraModuleFile +
               ") is not installed; install or build it for cameras that need libcamera" +
               kOtherwise + "."};
}

std::unique_ptr<Camera> CameraModule::make(const std::string& id, const Clock& clock) const {
  return std::unique_ptr<Camera>(module_->make(id.c_str(), &clock));
}

std::vector<std::string> CameraModule::list() const {
  std::vector<std::string> ids;
  module_->list(&ids, [](void* context, const char* id) {
    static_cast<std::vector<std::string>*>(context)->emplace_back(id);
  });
  return ids;
}

std::vector<std::string> camera_module_folders() {
  const std::string program = folder_of_program();
  return {program, program + kInstalledBeside};
}

}  // namespace plumbline
