// SPDX-License-Identifier: MIT
#include "sim/virtual_clock.h"

#include <algorithm>

namespace plumbline::sim {

VirtualClock::VirtualClock(HostTime start, WallTime wall)
    : now_(start), wall_minus_host_(wall.time_since_epoch() - start.time_since_epoch()) {}

WallReading VirtualClock::wall() const {
  return {now_, WallTime(now_.time_since_epoch() + wall_minus_host_), {}};
}

bool VirtualClock::wait(Signal& signal, HostTime deadline) {
  while (!signal.take()) {
    if (run_next(deadline)) continue;
    now_ = std::max(now_, deadline);
    return signal.take();
  }
  return true;
}

void VirtualClock::at(HostTime time, Action action) {
  actions_.emplace(std::max(time, now_), std::move(action));
}

void VirtualClock::run_until(HostTime time) {
  while (run_next(time)) {
  }
  now_ = std::max(now_, time);
}

// False where nothing is due until `last`.
bool VirtualClock::run_next(HostTime last) {
  const auto next = actions_.begin();
  if (next == actions_.end() || next->first > last) return false;
  now_ = std::max(now_, next->first);
  const Action action = std::move(next->second);
  actions_.erase(next);
  action();
  return true;
}

}  // namespace plumbline::sim
