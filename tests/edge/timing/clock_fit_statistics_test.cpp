// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "edge/timing/clock_fit.h"
#include "tests/edge/timing/coverage.h"
#include "tests/edge/timing/simulated_arrivals.h"

namespace plumbline::timing {
namespace {

// One look per flight, at `at_s`, so that the looks are independent.
Coverage coverage_of(const ArrivalSetting& setting, double at_s, int flights) {
  Coverage coverage;
  for (int flight = 0; flight < flights; ++flight) {
    sim::Random random(static_cast<std::uint64_t>(flight), 41);
    ArrivalSetting own = setting;
    own.crystal.rate = (flight % 2 == 0 ? 1 : -1) * random.uniform(20e-6, 100e-6);
    own.duration_s = at_s;
    const auto epochs = simulated_epochs(own, random);
    ClockFit fit;
    for (const SimulatedEpoch& epoch : epochs) fit.add(epoch.epoch, epoch.arrival);
    const auto clock = fit.estimate();
    if (!clock) continue;
    const auto host = clock->host_of(epochs.back().epoch);
    coverage.add(as_seconds(host.time - epochs.back().truth), as_seconds(host.sigma_fit));
  }
  return coverage;
}

class ClockFitStatistics : public testing::TestWithParam<sim::JitterLaw> {};

// The sigma is wider, mostly, than the errors: the law is not known, and the figures say by how
// much.
TEST_P(ClockFitStatistics, FollowsToFiveMillisecondsWithASigmaThatCovers) {
  if (PLUMBLINE_SANITIZED) GTEST_SKIP() << "statistics take too long under sanitizers";
  constexpr int kFlights = 100;
  std::puts("law          rate  after  rms, mean error, mean sigma (ms)  within 1, 2 sigma (%)");
  for (const double rate_hz : {1.0, 5.0}) {
    for (const double at_s : {60.0, 400.0}) {
      ArrivalSetting setting;
      setting.law = GetParam();
      setting.rate_hz = rate_hz;
      const Coverage c = coverage_of(setting, at_s, kFlights);
      std::printf("%-12s %g Hz  %3.0f s  %5.2f %5.2f %5.2f  %5.1f %5.1f\n",
                  std::string(sim::name_of(GetParam())).c_str(), rate_hz, at_s, 1e3 * c.rms(),
                  1e3 * c.mean(), 1e3 * c.mean_sigma(), c.percent_in_one(), c.percent_in_two());
      ASSERT_EQ(c.count, kFlights);
      EXPECT_LE(c.rms(), 5e-3);
      expect_covered(c);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Law, ClockFitStatistics, testing::ValuesIn(sim::kJitterLaws),
                         [](const auto& p) { return std::string(sim::name_of(p.param)); });

}  // namespace
}  // namespace plumbline::timing
