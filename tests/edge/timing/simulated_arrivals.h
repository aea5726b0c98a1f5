// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "edge/base/time.h"
#include "sim/arrival_times.h"

namespace plumbline::timing {

using std::chrono::nanoseconds;

inline nanoseconds of_seconds(double seconds) { return nanoseconds(std::llround(seconds * 1e9)); }
inline double as_seconds(nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

// Week 2400, some day, when the simulations begin; the host had been up for a quarter of an hour.
inline const GpsTime kGpsStart{std::chrono::weeks(2400) + std::chrono::seconds(123456)};
inline const HostTime kHostStart{std::chrono::seconds(900)};

struct SimulatedEpoch {
  GpsTime epoch;
  HostTime truth;    // the same instant on the host clock
  HostTime arrival;  // of its first byte
};

// Typed in for the tests: least latency, rate of the receiver, the host's crystal.
struct ArrivalSetting {
  sim::JitterLaw law = sim::JitterLaw::kExponential;
  double rate_hz = 5;
  double duration_s = 600;
  double latency_s = 0.080;
  sim::CrystalOptions crystal;
};

inline std::vector<SimulatedEpoch> simulated_epochs(const ArrivalSetting& setting,
                                                    sim::Random& random) {
  std::vector<double> times_s;
  const auto count = static_cast<int>(setting.duration_s * setting.rate_hz);
  for (int k = 0; k < count; ++k) times_s.push_back(k / setting.rate_hz);
  const std::vector<double> errors_s = sim::crystal_errors_s(setting.crystal, times_s, random);
  std::vector<SimulatedEpoch> epochs;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    const nanoseconds since = of_seconds(times_s[k]);
    const HostTime truth = kHostStart + since + of_seconds(errors_s[k]);
    const double late_s = setting.latency_s + sim::jitter_s(setting.law, random);
    epochs.push_back({kGpsStart + since, truth, truth + of_seconds(late_s)});
  }
  return epochs;
}

}  // namespace plumbline::timing
