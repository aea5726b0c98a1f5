// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "edge/base/time.h"

namespace plumbline {

// Numbers frames so that every one that was lost leaves a gap, also across a restart of the camera,
// which begins to count anew. A device counts in 32 bits, and wraps around. Pure; one thread.
class FrameAccount {
 public:
  struct Counted {
    std::uint64_t sequence = 0;
    std::uint64_t lost_before = 0;
  };

  // `nominal`: the period of the stream, by which what was lost in an outage is counted.
  void set_period(std::chrono::nanoseconds nominal) { period_ = nominal; }
  std::chrono::nanoseconds period() const { return period_; }

  // The device will count anew: the next gap is judged by time.
  void restarted() { device_sequence_.reset(); }

  // Whether it comes after one that was taken later, and has been counted as lost: uvcvideo, which
  // copies frames on several processors, may complete two in the wrong order. Not to be handed out.
  bool is_late(std::uint32_t device_sequence) const;

  // A frame to hand out. `stamp`: any instant that is the same in all frames (end, start).
  Counted frame(std::uint32_t device_sequence, HostTime stamp);

  // A frame that came damaged: returns how many are lost with it, itself included.
  std::uint64_t damaged(std::uint32_t device_sequence, HostTime stamp);

 private:
  std::uint64_t gap_before(std::uint32_t device_sequence, HostTime stamp) const;
  std::uint64_t gap_by_time(HostTime stamp) const;
  void remember(std::uint32_t device_sequence, HostTime stamp);

  std::chrono::nanoseconds period_{std::chrono::milliseconds(33)};
  std::uint64_t next_ = 0;
  std::optional<std::uint32_t> device_sequence_;  // of the last frame since the restart
  std::optional<HostTime> stamp_;                 // of the last frame at all
};

}  // namespace plumbline
