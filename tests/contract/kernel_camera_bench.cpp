// SPDX-License-Identifier: MIT
#include "tests/contract/kernel_camera_bench.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "drivers/camera/camera_module.h"
#include "drivers/camera/v4l2_camera.h"
#include "drivers/posix/system_clock.h"

namespace plumbline::contract {
namespace {

const std::string kLibcamera = "libcamera:";

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool run(const char* name) {
  const std::string command = from_environment(name);
  return !command.empty() && std::system(command.c_str()) == 0;
}

class KernelCameraBench : public CameraBench {
 public:
  explicit KernelCameraBench(std::string id) : id_(std::move(id)) {}

  std::unique_ptr<Camera> camera() override { return camera_of(id_); }
  std::unique_ptr<Camera> missing_camera() override {
    return camera_of(id_ + "-that-is-not-there");
  }

  CameraOptions options() override {
    CameraOptions options;
    options.width_px = 640;
    options.height_px = 360;
    const std::string size = from_environment("PLUMBLINE_TEST_CAMERA_SIZE");
    if (const std::size_t x = size.find('x'); x != std::string::npos) {
      options.width_px = std::stoi(size);
      options.height_px = std::stoi(size.substr(x + 1));
    }
    return options;
  }

  std::optional<std::chrono::nanoseconds> period() override {
    const V4l2Device device(id_);
    v4l2_streamparm parameters{};
    parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (device.open_error() != 0 || device.call(VIDIOC_G_PARM, &parameters) != 0) {
      return std::nullopt;
    }
    const v4l2_fract interval = parameters.parm.capture.timeperframe;
    return std::chrono::nanoseconds(1'000'000'000LL * interval.numerator / interval.denominator);
  }

  int pulls() override {
    const std::string count = from_environment("PLUMBLINE_TEST_CAMERA_PULLS");
    return count.empty() ? CameraBench::pulls() : std::stoi(count);
  }

  HostTime now() override { return clock_.now(); }
  void pass(std::chrono::nanoseconds time) override { std::this_thread::sleep_for(time); }

  bool inflict(CameraFault fault) override {
    switch (fault) {
      case CameraFault::kSilence:
        return run("PLUMBLINE_TEST_CAMERA_SILENCE") || set("Percentage of Dropped Buffers", 100);
      case CameraFault::kDrop:
        return set("Percentage of Dropped Buffers", 30);
      case CameraFault::kBrokenStream:
        return set("Inject Fatal Streaming Error", 1);
    }
    return false;
  }

  void mend() override {
    run("PLUMBLINE_TEST_CAMERA_SPEAK");
    set("Percentage of Dropped Buffers", 0);
  }

  bool unplug() override {
    if (from_environment("PLUMBLINE_TEST_CAMERA_REPLUG").empty()) return false;
    return run("PLUMBLINE_TEST_CAMERA_UNPLUG") || set("Disconnect", 1);
  }
  void plug_in() override { EXPECT_TRUE(run("PLUMBLINE_TEST_CAMERA_REPLUG")); }

 private:
  // "libcamera:" alone is the first that there is.
  std::unique_ptr<Camera> camera_of(const std::string& id) {
    if (!id.starts_with(kLibcamera)) return std::make_unique<V4l2Camera>(id, clock_);
    static const Result<CameraModule> module = CameraModule::load(camera_module_folders());
    if (!module) {
      ADD_FAILURE() << module.error().sentence;
      return nullptr;
    }
    const std::string name = id.substr(kLibcamera.size());
    const std::vector<std::string> found = module->list();
    return module->make(name.empty() && !found.empty() ? found.front() : name, clock_);
  }

  // By name, because the numbers of vivid's controls are in no header.
  bool set(const std::string& name, int value) {
    const V4l2Device device(id_);
    if (device.open_error() != 0) return false;
    v4l2_query_ext_ctrl query{};
    query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
    while (device.call(VIDIOC_QUERY_EXT_CTRL, &query) == 0) {
      if (name == query.name) {
        v4l2_control control{query.id, value};
        return device.call(VIDIOC_S_CTRL, &control) == 0;
      }
      query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    }
    return false;
  }

  std::string id_;
  posix::SystemClock clock_;
};

}  // namespace

std::unique_ptr<CameraBench> make_kernel_camera_bench(const std::string& id) {
  return std::make_unique<KernelCameraBench>(id);
}

}  // namespace plumbline::contract
