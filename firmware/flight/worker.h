// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "drivers/clock.h"
#include "drivers/signal.h"

namespace plumbline::flight {

// A thread that works when it is woken, and when it is due.
class Worker {
 public:
  struct Work {
    std::function<bool()> work;     // one piece; true: there may be more
    std::function<HostTime()> due;  // when to work unasked; max: never
  };

  // `clock` outlives it.
  Worker(Clock& clock, Work work)
      : clock_(clock), work_(std::move(work)), thread_([this] { run(); }) {}
  ~Worker() {
    stopping_ = true;
    signal_.raise();
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void wake() { signal_.raise(); }

  // Since when it has been at the piece it works on; empty: it waits. Any thread.
  std::optional<HostTime> busy_since() const {
    const HostTime since = busy_since_.load();
    return since == kIdle ? std::nullopt : std::optional(since);
  }

 private:
  static constexpr HostTime kIdle = HostTime::max();

  void run() {
    while (!stopping_) {
      while (work_one() && !stopping_) {
      }
      if (!stopping_) clock_.wait(signal_, work_.due());
    }
  }

  bool work_one() {
    busy_since_ = clock_.now();
    const bool may_be_more = work_.work();
    busy_since_ = kIdle;
    return may_be_more;
  }

  Clock& clock_;
  Work work_;
  Signal signal_;
  std::atomic<HostTime> busy_since_ = kIdle;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::flight
