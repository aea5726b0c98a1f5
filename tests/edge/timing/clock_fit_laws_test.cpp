// SPDX-License-Identifier: MIT
// The fit on laws of latency that it was not made with, while the crystal warms or cools.
#include <gtest/gtest.h>

#include <cstdio>

#include "edge/timing/clock_fit.h"
#include "tests/edge/timing/arrival_laws.h"
#include "tests/edge/timing/coverage.h"
#include "tests/edge/timing/simulated_arrivals.h"

namespace plumbline::timing {
namespace {

constexpr double kLatency_s = 0.080;
constexpr double kLargestRamp_per_s = 0.05e-6;  // 0.05 ppm more every second

// The error about the least latency at the last epoch of a flight, with its sigma.
void add_flight(const NamedLaw& named, double rate_hz, double duration_s, std::uint64_t seed,
                Coverage& coverage) {
  sim::Random random(seed, 61);
  const double rate = (random.uniform() < 0.5 ? -1 : 1) * random.uniform(20e-6, 100e-6);
  const double ramp = random.uniform(-kLargestRamp_per_s, kLargestRamp_per_s);
  const ArrivalLaw law = named.begun(random);
  ClockFitOptions options;
  options.poll = named.poll;
  ClockFit fit(options);
  GpsTime epoch;
  HostTime truth;
  for (double t = 0; t < duration_s; t += 1 / rate_hz) {
    epoch = kGpsStart + std::chrono::round<std::chrono::milliseconds>(of_seconds(t));
    truth = kHostStart + (epoch - kGpsStart) + of_seconds(rate * t + 0.5 * ramp * t * t);
    const HostTime at_least = truth + of_seconds(kLatency_s);
    fit.add(epoch, at_least + of_seconds(law(as_seconds(at_least.time_since_epoch()), random)));
  }
  const auto clock = fit.estimate();
  ASSERT_TRUE(clock);
  const auto host = clock->host_of(epoch);
  coverage.add(as_seconds(host.time - truth), as_seconds(host.sigma_fit));
}

class ClockFitLaws : public testing::TestWithParam<NamedLaw> {};

// 5 ms are asked for after a minute: ten arrivals of a law that begins thinly do not tell its floor
// any better than the sigma says.
TEST_P(ClockFitLaws, FollowsAWarmingCrystalToFiveMillisecondsWithASigmaThatCovers) {
  if (PLUMBLINE_SANITIZED) GTEST_SKIP() << "statistics take too long under sanitizers";
  constexpr int kFlights = 60;
  std::puts("law            rate  after  rms, mean error, mean sigma (ms)  within 1, 2 sigma (%)");
  for (const double rate_hz : {1.0, 5.0, 10.0}) {
    for (const double duration_s : {10.0, 60.0, 240.0}) {
      Coverage c;
      for (int flight = 0; flight < kFlights; ++flight) {
        add_flight(GetParam(), rate_hz, duration_s, static_cast<std::uint64_t>(flight), c);
      }
      std::printf("%-14s %2g Hz  %3.0f s  %5.2f %5.2f %5.2f  %5.1f %5.1f\n",
                  GetParam().name.c_str(), rate_hz, duration_s, 1e3 * c.rms(), 1e3 * c.mean(),
                  1e3 * c.mean_sigma(), c.percent_in_one(), c.percent_in_two());
      if (duration_s >= 60) {
        EXPECT_LE(c.rms(), 5e-3);
      }
      expect_covered(c);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Law, ClockFitLaws, testing::ValuesIn(arrival_laws()),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace plumbline::timing
