// SPDX-License-Identifier: MIT
#include "sim/sim_receiver.h"

#include <utility>

namespace plumbline::sim {

SimReceiver::SimReceiver(VirtualClock& clock, MakeFixDecoder make_decoder, std::string name)
    : clock_(clock), make_decoder_(std::move(make_decoder)), name_(std::move(name)) {}

SimReceiver::~SimReceiver() { SimReceiver::stop(); }

Status SimReceiver::start(Sink sink) {
  if (run_) return Error{name_ + " is being read already: stop it first."};
  run_ = std::shared_ptr<Run>(new Run{{make_decoder_, std::move(sink)}});
  run_->watch.set_name(name_);
  // The sink is not called before start() has returned.
  clock_.at(clock_.now(), [this, run = std::weak_ptr(run_)] {
    if (!run.expired()) begin();
  });
  return Done{};
}

void SimReceiver::begin() {
  if (!run_ || std::exchange(run_->begun, true)) return;
  in_ ? run_->watch.opened(clock_.now()) : run_->watch.absent(clock_.now(), absence());
  schedule_look();
}

void SimReceiver::stop() {
  if (!run_) return;
  run_->watch.cut(clock_.now());
  counters_ = run_->watch.counters();
  run_.reset();
}

ReceiverCounters SimReceiver::counters() const { return run_ ? run_->watch.counters() : counters_; }

void SimReceiver::plug_in() {
  begin();
  in_ = true;
  if (!run_) return;
  run_->watch.opened(clock_.now());
  schedule_look();
}

void SimReceiver::pull() {
  begin();
  in_ = false;
  if (run_) run_->watch.absent(clock_.now(), absence());
}

void SimReceiver::send(std::string_view bytes) {
  begin();
  if (!run_ || !in_) return;
  run_->watch.bytes(clock_.now(), bytes);
  schedule_look();
}

void SimReceiver::schedule_look() {
  const HostTime due = run_->watch.due(clock_.now());
  if (due >= run_->look_at) return;
  run_->look_at = due;
  clock_.at(due, [this, due, weak = std::weak_ptr(run_)] {
    const auto run = weak.lock();
    if (!run || run->look_at != due) return;  // one that is due earlier took its place
    run->look_at = HostTime::max();
    run->watch.look(clock_.now());
    schedule_look();
  });
}

std::string SimReceiver::absence() const {
  return name_ + " is pulled out: it is taken up as soon as it is back.";
}

}  // namespace plumbline::sim
