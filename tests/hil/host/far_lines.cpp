// SPDX-License-Identifier: MIT
#include "tests/hil/host/far_lines.h"

#include <algorithm>

namespace plumbline::hil {

using SteadyClock = std::chrono::steady_clock;

bool FarLines::open(const std::string& socket, SteadyTime second) {
  close();
  flash_.reset();
  const auto late = SteadyClock::now() - second;
  second_ = second + std::chrono::ceil<std::chrono::seconds>(late);
  lines_ = LineSocket();
  if (!lines_.open(socket)) return false;
  thread_ = std::jthread([this](const std::stop_token& stop) { live(stop); });
  return true;
}

std::vector<FarLines::SteadyTime> FarLines::exposures() const {
  const std::lock_guard lock(mutex_);
  return exposures_;
}

void FarLines::live(const std::stop_token& stop) {
  while (!stop.stop_requested() && lines_.is_open()) {
    if (lines_.next(std::min(second_, flash_.value_or(second_))) == "shutter" && !flash_) {
      flash_ = SteadyClock::now() + kDelay;
      const std::lock_guard lock(mutex_);
      exposures_.push_back(*flash_);
    }
    const SteadyTime now = SteadyClock::now();
    if (flash_ && now >= *flash_) {
      lines_.say("flash");
      flash_.reset();
    }
    if (now >= second_) {
      lines_.say("pps");
      second_ += std::chrono::seconds(1);
    }
  }
}

}  // namespace plumbline::hil
