// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "edge/base/time.h"
#include "edge/capture/inputs.h"
#include "firmware/flight/session.h"

namespace plumbline::service {

struct ProgressOptions {
  bool needs_frames = true;  // of a camera that streams
  // A driver says that its camera stalled after 1 s or two periods (20 s at the slowest rate that
  // the configuration takes): silence for so long means that the driver itself hangs.
  std::chrono::nanoseconds frame = std::chrono::seconds(30);
  // Of a photo: a second or two on the slowest computer, and no device is waited for.
  std::chrono::nanoseconds encoding = std::chrono::seconds(20);
  // Of one piece: a slow card syncs for some seconds.
  std::chrono::nanoseconds storing = std::chrono::seconds(10);
};

// Whether the daemon comes on: its deciding thread lives, and no deadline of camera, encoder or
// disk went by without a word. A device that is not there, and said so, is no lack of progress; nor
// is a disk that hangs and is known to: to start anew would cost the photos that wait in memory.
// Any thread.
class Progress {
 public:
  explicit Progress(const ProgressOptions& options) : options_(options) {}

  void lived();  // the deciding thread, through a round
  void heard(const capture::Input& input);

  struct State {
    std::uint64_t rounds = 0;
    std::string hangs;          // a sentence about what does, and should not; empty: nothing
    bool disk_is_late = false;  // it has been at one piece for longer than `storing`
  };
  State state(HostTime now, const flight::WorkAtHand& work) const;

 private:
  const ProgressOptions options_;
  mutable std::mutex mutex_;
  std::uint64_t rounds_ = 0;
  bool streams_ = false;
  HostTime sign_;  // of the camera, the last
};

}  // namespace plumbline::service
