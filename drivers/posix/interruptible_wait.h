// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "drivers/posix/descriptor.h"

namespace plumbline::posix {

// Waits for a descriptor, and lets another thread end the wait (an eventfd beside it in poll).
class InterruptibleWait {
 public:
  InterruptibleWait();

  // From any thread: ends the wait that is going on, or else the next one.
  void interrupt();

  // Until something of `events` (of poll) happens to `fd`, -1 for nothing to wait for. Returns what
  // happened; 0 when the time was over or the wait was ended.
  short wait(int fd, short events, std::chrono::nanoseconds at_most);

 private:
  Descriptor wake_up_;
};

}  // namespace plumbline::posix
