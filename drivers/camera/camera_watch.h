// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "drivers/camera.h"

namespace plumbline {

// Judges by the clock whether frames come as they should, and says each change once. Pure; one
// thread. `name` is the camera's for the sentences.
class CameraWatch {
 public:
  explicit CameraWatch(std::string name) : name_(std::move(name)) {}

  // Streaming was asked for; `period` between frames. Reported unless recovering from a failure,
  // which is over only with a frame.
  std::optional<CameraReport> starting(HostTime now, std::chrono::nanoseconds period);

  std::optional<CameraReport> frame(HostTime now);

  // Frames came, but none that could be handed out.
  void damaged_frame() { ++damaged_; }

  // Nothing can come while all buffers are lent: silence is not counted from before `now`.
  void excused(HostTime now) { last_sign_ = now; }

  // kStalled, once nothing came for two periods or 1 s, whichever is longer.
  std::optional<CameraReport> tick(HostTime now);

  // The device went away or failed. The same state again is not reported again.
  std::optional<CameraReport> failed(HostTime now, CameraState state, const std::string& sentence);

  HostTime stall_deadline() const;

  // Whether it was silent so long that only opening it anew may help.
  bool is_lost(HostTime now) const;

  // How long to wait before the next attempt to open it; grows with every one up to 1 s.
  std::chrono::milliseconds next_retry();

  CameraState state() const { return state_; }

 private:
  std::optional<CameraReport> change(HostTime now, CameraState state, std::string sentence);

  std::string name_;
  std::optional<CameraState> reported_;
  CameraState state_ = CameraState::kAbsent;
  std::chrono::nanoseconds period_{};
  HostTime last_sign_{};
  bool got_frame_ = false;  // since starting()
  int damaged_ = 0;         // since the last sound frame
  std::chrono::milliseconds retry_{};
};

}  // namespace plumbline
