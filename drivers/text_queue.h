// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "edge/base/pilot_messages.h"
#include "edge/base/time.h"

namespace plumbline {

struct WaitingText {
  PilotSeverity severity = PilotSeverity::kInfo;
  std::string text;
  HostTime said;
};

// The texts that a PilotLink has not sent yet, as its say() promises. Any thread pushes, and waits
// for no more than the lock; one thread pops.
class TextQueue {
 public:
  // Drops the oldest where it is full.
  void push(WaitingText text);

  // The oldest that is not too old at `now`; drops those that are.
  std::optional<WaitingText> pop(HostTime now);

  void count_dropped();  // a text that could not even wait
  void drop_all();
  std::uint64_t dropped() const;

 private:
  mutable std::mutex mutex_;
  std::deque<WaitingText> texts_;
  std::uint64_t dropped_ = 0;
};

}  // namespace plumbline
