// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drivers/camera.h"
#include "drivers/camera/camera_watch.h"
#include "drivers/camera/frame_account.h"
#include "drivers/camera/v4l2_session.h"
#include "drivers/clock.h"

namespace plumbline {

// A camera behind a Linux video device: /dev/video0, or a link to it in /dev/v4l/by-id. One thread
// of its own waits for frames. After a failure the device is closed and opened anew until it
// delivers; a camera that comes back under another name is known by its model and its socket.
class V4l2Camera : public Camera {
 public:
  // `clock` outlives it, and is that by which the kernel stamps frames.
  V4l2Camera(std::string path, const Clock& clock);
  ~V4l2Camera() override;

  Status start(const CameraOptions& options, Sink sink) override;
  void stop() override;
  void limit_exposure(std::chrono::microseconds longest) override;
  Result<CameraDescription> describe() override;

 private:
  void run();
  void open_session();
  void stream();
  int take_frames();
  bool take_frame();
  void fail_to_read(int error);
  void hand_out(const V4l2Slot& filled, HostTime arrival);
  void take_events();
  void take_new_limit();
  void fail(CameraState state, const std::string& sentence);
  void adopt(std::unique_ptr<V4l2Session> session);
  std::optional<std::string> device_path() const;
  int milliseconds_until(HostTime deadline) const;
  bool wait(short events, HostTime deadline, short& happened);
  void send(CameraEvent event) { sink_(std::move(event)); }
  void send(std::optional<CameraReport> report);

  const std::string path_;
  const Clock& clock_;
  CameraOptions options_;
  Sink sink_;
  std::thread thread_;
  int wake_fd_ = -1;
  std::atomic<bool> stopping_{false};
  std::atomic<std::int64_t> new_limit_us_{-1};

  // Of the thread, while it runs.
  std::unique_ptr<V4l2Session> session_;
  V4l2Identity identity_;  // of the camera that was first seen
  std::optional<CameraInterior> interior_;
  int interior_number_ = 0;
  std::vector<std::string> said_;  // notices
  CameraWatch watch_;
  FrameAccount account_;
};

// What there is behind a video device, streaming or not.
Result<CameraDescription> describe_v4l2(const std::string& path);

// The paths of all video devices from which frames can be taken, in order of their numbers.
std::vector<std::string> list_v4l2();

}  // namespace plumbline
