// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "drivers/clock.h"

namespace plumbline::sim {

// The time of a simulation: it stands still while code runs and jumps while code waits, from one
// action of a simulated device to the next. One thread alone uses it and all devices on it; the
// same actions give the same order, always: by time, then by when they were asked for.
class VirtualClock : public Clock {
 public:
  using Action = std::function<void()>;

  // Begins at `start`; the wall then shows `wall`.
  explicit VirtualClock(HostTime start = HostTime{}, WallTime wall = WallTime{});

  HostTime now() const override { return now_; }
  WallReading wall() const override;
  bool wait(Signal& signal, HostTime deadline) override;

  // Runs `action` when the time comes, at once (in the next wait) if it has passed. Actions may ask
  // for more.
  void at(HostTime time, Action action);
  void after(std::chrono::nanoseconds delay, Action action) { at(now_ + delay, std::move(action)); }

  std::size_t pending() const { return actions_.size(); }  // actions still to come
  HostTime due() const { return actions_.empty() ? HostTime::max() : actions_.begin()->first; }

  // Lives through everything up to and at `time`.
  void run_until(HostTime time);

  // The calendar is set, as by a person or NTP: the wall jumps, the host time does not.
  void step_wall(std::chrono::nanoseconds by) { wall_minus_host_ += by; }

 private:
  bool run_next(HostTime last);

  HostTime now_;
  std::chrono::nanoseconds wall_minus_host_;
  std::multimap<HostTime, Action> actions_;  // equal keys stay in order of insertion
};

}  // namespace plumbline::sim
