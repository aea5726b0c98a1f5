// SPDX-License-Identifier: MIT
#include "firmware/service/life/life_signs.h"

#include <chrono>
#include <utility>

namespace plumbline::service {
namespace {

constexpr std::chrono::milliseconds kLookEvery{500};

}  // namespace

LifeSigns::LifeSigns(const ServiceManager& manager, LifeSources sources)
    : look_(manager, std::move(sources)), thread_([this] { run(); }) {}

LifeSigns::~LifeSigns() {
  stop_.raise();
  thread_.join();
}

void LifeSigns::run() {
  do {
    look_.now();
  } while (!stop_.take_until(std::chrono::steady_clock::now() + kLookEvery));
}

void LifeSigns::Look::now() {
  const Progress::State state = sources_.progress();
  tell_what_hangs(state);
  if (state.rounds == 0) return;  // not up yet
  show();
  const bool came_on = std::exchange(rounds_, state.rounds) != state.rounds;
  if (came_on && state.hangs.empty()) sent(manager_.lives());
}

void LifeSigns::Look::show() {
  const std::string sentence = sources_.sentence();
  if (rounds_ == 0) {
    sent(manager_.ready(sentence));
  } else if (sentence != shown_) {
    sent(manager_.show(sentence));
  }
  shown_ = sentence;
}

void LifeSigns::Look::tell_what_hangs(const Progress::State& state) {
  if (std::exchange(hangs_, state.hangs) != state.hangs && !state.hangs.empty()) {
    sources_.say(record::Severity::kFault, "program", state.hangs);
  }
  if (std::exchange(disk_is_late_, state.disk_is_late) == state.disk_is_late) return;
  if (state.disk_is_late) {
    sources_.say(record::Severity::kFault, "disk",
                 "It has not answered for a long time; photos wait in memory.");
  } else {
    sources_.say(record::Severity::kInfo, "disk", "It answers again.");
  }
}

void LifeSigns::Look::sent(const Status& status) {
  if (status || std::exchange(is_deaf_, true)) return;
  sources_.say(record::Severity::kWarning, "program", status.error().sentence);
}

}  // namespace plumbline::service
