// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "drivers/signal.h"

namespace plumbline {

// What the devices report, on its way to the one thread that decides. Any thread pushes, and never
// waits for more than the lock; one thread pops. Unbounded: events are small, and whoever sends
// frames holds them by a lent buffer of which the driver has few.
template <typename Event>
class EventQueue {
 public:
  // `signal` is raised with every event and outlives the queue.
  explicit EventQueue(Signal& signal) : signal_(signal) {}

  void push(Event event) {
    {
      const std::lock_guard lock(mutex_);
      events_.push_back(std::move(event));
    }
    signal_.raise();
  }

  // The oldest, if there is one.
  std::optional<Event> pop() {
    const std::lock_guard lock(mutex_);
    if (events_.empty()) return std::nullopt;
    std::optional<Event> oldest(std::move(events_.front()));
    events_.pop_front();
    return oldest;
  }

 private:
  Signal& signal_;
  std::mutex mutex_;
  std::deque<Event> events_;
};

}  // namespace plumbline
