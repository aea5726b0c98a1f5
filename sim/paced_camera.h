// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <thread>

#include "drivers/camera.h"
#include "drivers/clock.h"
#include "drivers/event_queue.h"
#include "sim/sim_camera.h"
#include "sim/virtual_clock.h"

namespace plumbline::sim {

// A simulated camera that lives in real time, on a thread of its own. Its picture may take longer
// to make than to take: the frame then comes late, with the right time of exposure; frames that
// fall due meanwhile are lost, and counted.
class PacedCamera : public Camera {
 public:
  // `clock` outlives it.
  PacedCamera(Clock& clock, SimCameraOptions options);
  ~PacedCamera() override;

  Status start(const CameraOptions& options, Sink sink) override;
  void stop() override;
  void limit_exposure(std::chrono::microseconds longest) override;
  Result<CameraDescription> describe() override;

  // As SimCamera's; from any thread.
  void release(HostTime first_row_start) { releases_.push(first_row_start); }

 private:
  void live(const std::stop_token& stop);
  HostTime catch_up();  // to now; when there is more to do

  Clock& clock_;
  Signal signal_;
  EventQueue<HostTime> releases_;
  bool runs_freely_;
  std::mutex mutex_;  // of the camera and its clock
  VirtualClock virtual_clock_;
  SimCamera camera_;
  std::jthread thread_;
};

}  // namespace plumbline::sim
