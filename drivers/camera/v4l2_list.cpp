// SPDX-License-Identifier: MIT
#include <dirent.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/v4l2_camera.h"

namespace plumbline {
namespace {

constexpr const char* kPrefix = "video";

std::vector<int> numbers_of_video_devices() {
  std::vector<int> numbers;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir("/dev"), ::closedir);
  if (!folder) return numbers;
  while (const dirent* entry = ::readdir(folder.get())) {
    const std::string name = entry->d_name;
    if (!name.starts_with(kPrefix) || name.size() <= 5 || name.size() > 9) continue;
    const std::string digits = name.substr(5);
    if (digits.find_first_not_of("0123456789") == std::string::npos) {
      numbers.push_back(std::stoi(digits));
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

std::vector<std::string> list_v4l2() {
  std::vector<std::string> paths;
  for (const int number : numbers_of_video_devices()) {
    const std::string path = "/dev/" + std::string(kPrefix) + std::to_string(number);
    const V4l2Device device(path);
    // What may not be opened is listed too: asked for, it says why.
    if (device.open_error() == EACCES ||
        (device.open_error() == 0 && identity_of(device).streams_video)) {
      paths.push_back(path);
    }
  }
  return paths;
}

Result<CameraDescription> describe_v4l2(const std::string& path) {
  const V4l2Device device(path);
  if (device.open_error() != 0) return Error{sentence_of(path, "open", device.open_error())};
  const V4l2Identity identity = identity_of(device);
  if (!identity.streams_video) return Error{identity.why_not};
  CameraDescription description{path, identity.card, identity.driver, modes_of(device), {}};
  for (const V4l2Control& control : controls_of(device)) {
    description.controls.push_back({control.name, static_cast<double>(control.minimum),
                                    static_cast<double>(control.maximum),
                                    static_cast<double>(control.value)});
  }
  return description;
}

}  // namespace plumbline
