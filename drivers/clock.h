// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/signal.h"
#include "edge/base/time.h"
#include "edge/base/wall_reading.h"

namespace plumbline {

// SEAM: the time, and waiting for it. Every member may be called from any thread; wait() by one
// thread per Signal. Nothing here fails.
class Clock {
 public:
  virtual ~Clock() = default;

  virtual HostTime now() const = 0;

  // The best (least spread) of a few attempts.
  virtual WallReading wall() const = 0;

  // Returns true as soon as `signal` has been raised (and lowers it), false at `deadline`. A clock
  // of a simulation lets its devices live through the time in between, on the caller's thread.
  virtual bool wait(Signal& signal, HostTime deadline) = 0;
};

}  // namespace plumbline
