// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/trigger_line.h"
#include "sim/random.h"
#include "sim/virtual_clock.h"

namespace plumbline::sim {

struct TriggerLineFaults {
  double doubled = 0;  // share of edges that bounce: the same pulse again after 200 us
  double lost = 0;     // share of edges that are not seen
  bool inverted = false;
  std::chrono::nanoseconds jitter_sigma{};  // of the kernel's stamp, always late
};

// A wire without hardware. A camera at its far end sees the pulses and answers.
class SimTriggerLine : public TriggerLine {
 public:
  // `clock` outlives it.
  SimTriggerLine(VirtualClock& clock, std::chrono::nanoseconds pulse_width, std::uint64_t seed = 1,
                 TriggerLineFaults faults = {});
  ~SimTriggerLine() override;

  Result<Pulse> pulse() override;
  Status listen(Sink sink) override;
  void stop() override;

  const std::vector<Pulse>& pulses() const { return pulses_; }

  // The far end drives the input line at a time to come: active or not.
  void drive(HostTime time, bool active);
  // The chip is pulled out at a time to come.
  void unplug(HostTime time);

 private:
  // What scheduled actions reach, until the line is gone.
  struct Listener {
    Sink sink;
    std::uint64_t next = 0;
    std::uint64_t lost = 0;
  };

  void edge(HostTime time, bool active);

  VirtualClock& clock_;
  std::chrono::nanoseconds pulse_width_;
  Random random_;
  TriggerLineFaults faults_;
  std::vector<Pulse> pulses_;
  std::shared_ptr<Listener> listener_;
};

}  // namespace plumbline::sim
