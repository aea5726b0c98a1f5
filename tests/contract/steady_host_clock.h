// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/clock.h"

namespace plumbline::contract {

// The host's clock as the standard library has it: as little as a test of another seam needs.
class SteadyHostClock : public Clock {
 public:
  HostTime now() const override {
    return HostTime(std::chrono::steady_clock::now().time_since_epoch());
  }
  WallReading wall() const override { return {now(), {}, {}}; }
  bool wait(Signal& signal, HostTime deadline) override {
    return signal.take_until(std::chrono::steady_clock::time_point(deadline.time_since_epoch()));
  }
};

}  // namespace plumbline::contract
