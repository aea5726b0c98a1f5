// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>

#include "drivers/gnss_receiver.h"

namespace plumbline::commands {

// How the last 50 fixes arrived.
class ArrivalStatistics {
 public:
  void add(const ReceivedFix& fix);

  std::optional<double> rate_hz() const;  // empty before the second fix

  // By how much the delay from the instant of a fix to its first byte varies: what all but one in
  // twenty stay within above the least. The least itself cannot be told from arrivals. Empty where
  // no date is known yet.
  std::optional<double> latency_spread_ms() const;

 private:
  struct Arrival {
    HostTime first_byte;
    std::optional<UtcTime> time;
  };

  std::deque<Arrival> last_;
};

}  // namespace plumbline::commands
