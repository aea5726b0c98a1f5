// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
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

 private:
  void run() {
    while (!stopping_) {
      while (work_.work() && !stopping_) {
      }
      if (!stopping_) clock_.wait(signal_, work_.due());
    }
  }

  Clock& clock_;
  Work work_;
  Signal signal_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::flight
