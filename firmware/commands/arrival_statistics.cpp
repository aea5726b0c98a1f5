// SPDX-License-Identifier: MIT
#include "firmware/commands/arrival_statistics.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace plumbline::commands {
namespace {

constexpr std::size_t kMost = 50;

}  // namespace

void ArrivalStatistics::add(const ReceivedFix& fix) {
  last_.push_back({fix.first_byte, fix.fix.time});
  if (last_.size() > kMost) last_.pop_front();
}

std::optional<double> ArrivalStatistics::rate_hz() const {
  if (last_.size() < 2) return std::nullopt;
  const std::chrono::duration<double> span = last_.back().first_byte - last_.front().first_byte;
  if (span.count() <= 0) return std::nullopt;
  return static_cast<double>(last_.size() - 1) / span.count();
}

std::optional<double> ArrivalStatistics::latency_spread_ms() const {
  std::vector<double> delays_ms;
  for (const Arrival& arrival : last_) {
    if (!arrival.time) continue;
    const auto delay = arrival.first_byte.time_since_epoch() - arrival.time->time_since_epoch();
    delays_ms.push_back(std::chrono::duration<double, std::milli>(delay).count());
  }
  if (delays_ms.size() < 2) return std::nullopt;
  std::sort(delays_ms.begin(), delays_ms.end());
  return delays_ms[(delays_ms.size() - 1) * 19 / 20] - delays_ms.front();
}

}  // namespace plumbline::commands
