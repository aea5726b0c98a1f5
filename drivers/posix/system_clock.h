// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/clock.h"

namespace plumbline::posix {

// The clocks of the system: CLOCK_MONOTONIC, and CLOCK_REALTIME for the wall.
class SystemClock : public Clock {
 public:
  HostTime now() const override;
  WallReading wall() const override;
  bool wait(Signal& signal, HostTime deadline) override;
};

}  // namespace plumbline::posix
