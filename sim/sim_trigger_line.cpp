// SPDX-License-Identifier: MIT
#include "sim/sim_trigger_line.h"

#include <cmath>
#include <utility>

namespace plumbline::sim {
namespace {

constexpr std::chrono::microseconds kBounce{200};

}  // namespace

SimTriggerLine::SimTriggerLine(VirtualClock& clock, std::chrono::nanoseconds pulse_width,
                               std::uint64_t seed, TriggerLineFaults faults)
    : clock_(clock),
      pulse_width_(pulse_width),
      random_(seed, 1),
      faults_(faults),
      listener_(std::make_shared<Listener>()) {}

SimTriggerLine::~SimTriggerLine() { SimTriggerLine::stop(); }

Result<Pulse> SimTriggerLine::pulse() {
  const HostTime now = clock_.now();
  clock_.run_until(now + pulse_width_);
  pulses_.push_back({now, now, pulse_width_});
  return pulses_.back();
}

Status SimTriggerLine::listen(Sink sink) {
  if (listener_->sink) return Error{"The trigger line is listened to already."};
  *listener_ = {std::move(sink)};
  return Done{};
}

void SimTriggerLine::stop() { listener_->sink = nullptr; }

void SimTriggerLine::drive(HostTime time, bool active) {
  if (random_.uniform() < faults_.lost) {
    clock_.at(time, [listener = listener_] { ++listener->lost; });
    return;
  }
  edge(time, active);
  if (random_.uniform() < faults_.doubled) {
    edge(time + kBounce, !active);
    edge(time + 2 * kBounce, active);
  }
}

void SimTriggerLine::edge(HostTime time, bool active) {
  const double late_ns =
      std::abs(random_.normal()) * static_cast<double>(faults_.jitter_sigma.count());
  const HostTime stamp = time + std::chrono::nanoseconds(std::llround(late_ns));
  const bool rising = active != faults_.inverted;
  clock_.at(stamp, [listener = listener_, stamp, rising] {
    if (!listener->sink) return;
    if (const std::uint64_t lost = std::exchange(listener->lost, 0); lost > 0) {
      listener->next += lost;
      listener->sink(EdgesLost{stamp, lost});
    }
    if (listener->sink) listener->sink(LineEdge{stamp, rising, listener->next++});
  });
}

void SimTriggerLine::unplug(HostTime time) {
  clock_.at(time, [listener = listener_, time] {
    const Sink sink = std::exchange(listener->sink, nullptr);
    if (sink) sink(LineFault{time, "The GPIO chip of the trigger line is gone: plug it in again."});
  });
}

}  // namespace plumbline::sim
