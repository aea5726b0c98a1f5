// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <mutex>
#include <utility>

namespace plumbline {

// A flag that one thread waits for and any thread raises. Raised twice, it is taken once.
class Signal {
 public:
  void raise() {
    {
      const std::lock_guard lock(mutex_);
      raised_ = true;
    }
    changed_.notify_one();
  }

  // Lowers it; true if it was raised.
  bool take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(raised_, false);
  }

  // Until raised or the deadline of a steady clock; then as take().
  template <typename SteadyTime>
  bool take_until(const SteadyTime& deadline) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return raised_; });
    return std::exchange(raised_, false);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool raised_ = false;
};

}  // namespace plumbline
