// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "sim/camera_link.h"
#include "sim/virtual_clock.h"

namespace plumbline::sim {

// A frame of a recording: when it was exposed, and its JPEG file, read when its time has come.
struct RecordedFrame {
  Frame frame;  // without image; its sequence as recorded: gaps are frames that were lost
  std::function<Result<std::vector<std::uint8_t>>()> jpeg;
};

struct Recording {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  std::vector<RecordedFrame> frames;                                 // in order
  std::chrono::nanoseconds delivery{std::chrono::milliseconds(30)};  // from the last row's end
};

// Plays recorded frames on the virtual clock, at the host times at which they were exposed. A frame
// whose file cannot be read is lost. At the end of the recording the camera is absent. One thread.
class ReplayCamera : public Camera {
 public:
  ReplayCamera(VirtualClock& clock, Recording recording);
  ~ReplayCamera() override;

  Status start(const CameraOptions& options, Sink sink) override;
  void stop() override;
  void limit_exposure(std::chrono::microseconds longest) override;  // a notice: it was as it was
  Result<CameraDescription> describe() override;

 private:
  struct Running;

  HostTime delivery_of(const RecordedFrame& recorded) const;
  void schedule(std::size_t index);
  void deliver(std::size_t index);
  void at(HostTime time, std::function<void()> action);

  VirtualClock& clock_;
  Recording recording_;
  std::shared_ptr<Running> running_;
};

}  // namespace plumbline::sim
