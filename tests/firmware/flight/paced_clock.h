// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <thread>

#include "sim/virtual_clock.h"

namespace plumbline::flight {

// A simulated world that runs by the real clock, faster by a factor: for programs with threads. The
// world goes on while the thread that made this waits; other threads just wait.
class PacedClock : public Clock {
 public:
  PacedClock(sim::VirtualClock& world, int faster)
      : world_(world), faster_(faster), begun_(world.now()), real_begun_(Real::now()) {}

  HostTime now() const override { return begun_ + faster_ * (Real::now() - real_begun_); }
  WallReading wall() const override { return {now(), WallTime(now().time_since_epoch()), {}}; }

  bool wait(Signal& signal, HostTime deadline) override {
    while (!signal.take()) {
      const HostTime now = this->now();
      if (now >= deadline) return false;
      if (std::this_thread::get_id() == owner_) world_.run_until(now);
      const auto piece = std::min<std::chrono::nanoseconds>(deadline - now, kPiece);
      if (signal.take_until(Real::now() + piece / faster_)) return true;
    }
    return true;
  }

  void sleep(std::chrono::nanoseconds time) const { std::this_thread::sleep_for(time / faster_); }

 private:
  using Real = std::chrono::steady_clock;
  static constexpr std::chrono::nanoseconds kPiece = std::chrono::milliseconds(10);

  sim::VirtualClock& world_;
  int faster_;
  HostTime begun_;
  Real::time_point real_begun_;
  std::thread::id owner_ = std::this_thread::get_id();
};

}  // namespace plumbline::flight
