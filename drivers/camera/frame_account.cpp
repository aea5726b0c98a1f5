// SPDX-License-Identifier: MIT
#include "drivers/camera/frame_account.h"

#include <cmath>

namespace plumbline {
namespace {

// More frames than a camera can lose between two without being called stalled: beyond it the
// device's count is no count (some drivers leave it 0, or start it anew).
constexpr std::uint32_t kLargestGap = 1000;

// Frames can overtake each other only while both are in buffers.
constexpr std::uint32_t kMostBuffers = 32;

}  // namespace

bool FrameAccount::is_late(std::uint32_t device_sequence) const {
  const std::uint32_t behind = device_sequence_.value_or(device_sequence) - device_sequence;
  return behind >= 1 && behind <= kMostBuffers;
}

FrameAccount::Counted FrameAccount::frame(std::uint32_t device_sequence, HostTime stamp) {
  const std::uint64_t lost = gap_before(device_sequence, stamp);
  remember(device_sequence, stamp);
  const Counted counted{next_ + lost, lost};
  next_ = counted.sequence + 1;
  return counted;
}

std::uint64_t FrameAccount::damaged(std::uint32_t device_sequence, HostTime stamp) {
  const std::uint64_t lost = gap_before(device_sequence, stamp) + 1;
  remember(device_sequence, stamp);
  next_ += lost;
  return lost;
}

std::uint64_t FrameAccount::gap_before(std::uint32_t device_sequence, HostTime stamp) const {
  if (!device_sequence_) return gap_by_time(stamp);
  const std::uint32_t step = device_sequence - *device_sequence_;  // modulo 2^32
  const bool counts = step >= 1 && step <= kLargestGap;
  return counts ? step - 1 : gap_by_time(stamp);
}

std::uint64_t FrameAccount::gap_by_time(HostTime stamp) const {
  if (!stamp_ || stamp <= *stamp_) return 0;
  const double periods = std::chrono::duration<double>(stamp - *stamp_) / period_;
  return periods < 1.5 ? 0 : static_cast<std::uint64_t>(std::llround(periods)) - 1;
}

void FrameAccount::remember(std::uint32_t device_sequence, HostTime stamp) {
  device_sequence_ = device_sequence;
  stamp_ = stamp;
}

}  // namespace plumbline
