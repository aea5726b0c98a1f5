// SPDX-License-Identifier: MIT
#include "sim/recording_pilot_link.h"

#include <chrono>
#include <utility>

#include "edge/mavlink/messages.h"

namespace plumbline::sim {
namespace {

constexpr std::chrono::milliseconds kTick{250};
constexpr std::chrono::seconds kBetweenHeartbeats{1};

}  // namespace

RecordingPilotLink::RecordingPilotLink(VirtualClock& clock, std::string name)
    : clock_(clock), name_(std::move(name)) {}

RecordingPilotLink::~RecordingPilotLink() { RecordingPilotLink::stop(); }

Status RecordingPilotLink::start(Sink sink) {
  if (run_) return Error{name_ + " is in use already: stop it first."};
  run_ = std::shared_ptr<Run>(
      new Run{sink, PilotJudge(name_, [sink](const PilotReport& report) { sink(report); })});
  // The sink is not called before start() has returned.
  clock_.at(clock_.now(), [this, run = std::weak_ptr(run_)] {
    if (!run.expired()) begin();
  });
  return Done{};
}

void RecordingPilotLink::begin() {
  if (!run_ || std::exchange(run_->begun, true)) return;
  in_ ? open() : run_->judge.absent(clock_.now(), absence());
  tick();
}

void RecordingPilotLink::open() {
  if (std::exchange(run_->was_in, true)) ++counters_.reconnections;
  next_heartbeat_ = clock_.now();
  run_->judge.opened(clock_.now());
}

void RecordingPilotLink::tick() {
  run_->judge.look(clock_.now());
  show_waiting();
  clock_.after(kTick, [this, run = std::weak_ptr(run_)] {
    if (!run.expired()) tick();
  });
}

void RecordingPilotLink::stop() {
  run_.reset();
  texts_.drop_all();
}

void RecordingPilotLink::say(PilotSeverity severity, std::string_view text) {
  if (!run_) {
    texts_.count_dropped();
    return;
  }
  texts_.push({severity, std::string(text), clock_.now()});
  show_waiting();
}

void RecordingPilotLink::show_waiting() {
  const HostTime now = clock_.now();
  if (!run_->was_in || !in_) return;
  if (now >= next_heartbeat_) {
    heartbeats_.push_back(now);
    ++counters_.heartbeats_sent;
    next_heartbeat_ = now + kBetweenHeartbeats;
  }
  while (const auto text = texts_.pop(now)) {
    shown_.push_back({now, text->severity, mavlink::fitted(text->text)});
    ++counters_.texts_sent;
  }
}

PilotLinkCounters RecordingPilotLink::counters() const {
  PilotLinkCounters counters = counters_;
  counters.texts_dropped = texts_.dropped();
  return counters;
}

void RecordingPilotLink::plug_in() {
  begin();
  in_ = true;
  if (!run_) return;
  open();
  show_waiting();
}

void RecordingPilotLink::pull() {
  begin();
  in_ = false;
  if (run_) run_->judge.absent(clock_.now(), absence());
}

bool RecordingPilotLink::hears() {
  begin();
  if (!run_ || !in_) return false;
  run_->judge.bytes_came(clock_.now());
  return true;
}

void RecordingPilotLink::hear(PilotMessage message) {
  if (!hears()) return;
  const HostTime now = clock_.now();
  const Sink sink = run_->sink;
  ++counters_.heard.frames;
  run_->judge.frame_came(now);
  if (std::holds_alternative<PilotHeartbeat>(message)) run_->judge.heartbeat_came(now);
  std::visit(
      [&](auto& said) {
        said.arrival = now;
        sink(said);
      },
      message);
}

void RecordingPilotLink::hear_another() {
  if (!hears()) return;
  ++counters_.heard.of_others;
  ++counters_.heard.frames;
  run_->judge.frame_came(clock_.now());
}

void RecordingPilotLink::hear_noise() {
  if (hears()) ++counters_.heard.garbage_bytes;
}

std::string RecordingPilotLink::absence() const {
  return name_ + " is pulled out: it is taken up as soon as it is back.";
}

}  // namespace plumbline::sim
