// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/hil/host/line_socket.h"

namespace plumbline::hil {

// The far ends of the guest's lines (guest/system/bench-lines): the receiver's pulse per second,
// and a camera that keeps its photos. It exposes some time after the pulse on its shutter, and
// answers on the line of its flash.
class FarLines {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  // From pulse to the middle of the exposure.
  static constexpr std::chrono::milliseconds kDelay{60};

  ~FarLines() { close(); }

  // Pulses come at `second` and every second from there. False where the guest has no such port.
  bool open(const std::string& socket, SteadyTime second);
  void close() { thread_ = {}; }

  // The middle of each exposure so far.
  std::vector<SteadyTime> exposures() const;

 private:
  void live(const std::stop_token& stop);

  LineSocket lines_;
  SteadyTime second_;
  std::optional<SteadyTime> flash_;  // of the exposure that is to come
  mutable std::mutex mutex_;
  std::vector<SteadyTime> exposures_;
  std::jthread thread_;
};

}  // namespace plumbline::hil
