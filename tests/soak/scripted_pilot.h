// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "drivers/pilot_link.h"
#include "sim/virtual_clock.h"

namespace plumbline::soak {

// An autopilot that says once a second whether it is armed, and keeps nothing of what it is told.
class ScriptedPilot : public PilotLink {
 public:
  ScriptedPilot(sim::VirtualClock& clock, std::function<bool(HostTime)> armed)
      : clock_(clock), armed_(std::move(armed)) {}

  Status start(Sink sink) override {
    sink_ = std::make_shared<Sink>(std::move(sink));
    (*sink_)(PilotReport{clock_.now(), PilotState::kAutopilot, "An autopilot is heard."});
    beat(sink_);
    return Done{};
  }
  void stop() override { sink_.reset(); }
  void say(PilotSeverity, std::string_view) override { ++counters_.texts_sent; }
  std::string name() const override { return "the scripted autopilot"; }
  PilotLinkCounters counters() const override { return counters_; }

 private:
  void beat(const std::weak_ptr<Sink>& sink) {
    const auto hears = sink.lock();
    if (!hears) return;
    PilotHeartbeat heartbeat;
    heartbeat.arrival = clock_.now();
    heartbeat.armed = armed_(heartbeat.arrival);
    heartbeat.system_id = 1;
    (*hears)(heartbeat);
    clock_.after(std::chrono::seconds(1), [this, sink] { beat(sink); });
  }

  sim::VirtualClock& clock_;
  std::function<bool(HostTime)> armed_;
  std::shared_ptr<Sink> sink_;
  PilotLinkCounters counters_;
};

}  // namespace plumbline::soak
