// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "drivers/clock.h"
#include "drivers/trigger_line.h"
#include "sim/random.h"

namespace plumbline::sim {

// The wire to a simulated camera's shutter, in real time. No wire comes back: the camera's frames
// say when it exposed.
class ReleaseWire : public TriggerLine {
 public:
  struct Options {
    std::chrono::nanoseconds width = std::chrono::milliseconds(20);
    std::chrono::nanoseconds delay = std::chrono::milliseconds(100);  // to the exposure's start
    std::chrono::nanoseconds delay_sigma = std::chrono::milliseconds(2);
    std::uint64_t seed = 1;
  };

  // `clock` outlives it. `release` is called from the thread that pulses.
  ReleaseWire(Clock& clock, const Options& options, std::function<void(HostTime)> release);

  Result<Pulse> pulse() override;
  Status listen(Sink sink) override;
  void stop() override {}

 private:
  Clock& clock_;
  Options options_;
  Random random_;
  std::function<void(HostTime)> release_;
};

}  // namespace plumbline::sim
