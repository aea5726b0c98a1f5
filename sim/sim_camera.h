// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "drivers/camera.h"
#include "edge/base/image.h"
#include "sim/camera_link.h"
#include "sim/virtual_clock.h"

namespace plumbline::sim {

// What the camera sees: an image of the camera's size, 1 or 3 channels, exposed as `exact` says.
using PictureSource = std::function<Image(const ExposureTiming& exact)>;

struct SimCameraOptions {
  std::string id = "simulated";
  int width_px = 16;
  int height_px = 12;
  int channels = 1;
  double frames_per_s = 10;
  std::chrono::nanoseconds row_time{std::chrono::microseconds(20)};
  std::chrono::nanoseconds sigma_interval{};  // of each exposure about the even rate
  std::chrono::nanoseconds sigma_stamp{};     // of the time that is stated for it; stated, too
  std::chrono::nanoseconds delivery{std::chrono::milliseconds(30)};  // from the last row's end
  double drop_probability = 0;
  int buffers = 5;
  bool released = false;  // exposes when release() says so, instead of running freely
  unsigned seed = 1;
  PictureSource picture;  // nullptr: even grey that changes from frame to frame
};

// A camera on the virtual clock, running freely or released, whose faults are at hand. One thread:
// that of the clock.
class SimCamera : public Camera {
 public:
  SimCamera(VirtualClock& clock, SimCameraOptions options);
  ~SimCamera() override;

  Status start(const CameraOptions& options, Sink sink) override;
  void stop() override;
  void limit_exposure(std::chrono::microseconds longest) override;
  Result<CameraDescription> describe() override;

  // Exposes once, from that time on. After start().
  void release(HostTime first_row_start);

  // Faults, also before start(). A camera that is away or silent still lets its frames pass by
  // unseen, and counts them as lost when it is back.
  void silence(bool on);
  void drop(double probability) { options_.drop_probability = probability; }
  void break_stream();  // one failure of a read; it is opened anew, for two periods without frames
  void unplug();
  void plug_in();

 private:
  struct Running;  // from start() to stop(); what the clock still holds dies with it

  void schedule_frame();
  void expose(HostTime first_row_start);
  void begin();
  void deliver(const ExposureTiming& exact);
  void watch_for_silence();
  bool sees() const;
  ExposureTiming stated(const ExposureTiming& exact);
  FramePixels picture_of(const ExposureTiming& exact);
  void at(HostTime time, std::function<void()> action);
  std::chrono::nanoseconds gaussian(std::chrono::nanoseconds sigma);

  VirtualClock& clock_;
  SimCameraOptions options_;
  std::chrono::nanoseconds period_;
  std::mt19937_64 random_;
  std::shared_ptr<Running> running_;
  bool plugged_ = true;
  bool silent_ = false;
};

}  // namespace plumbline::sim
