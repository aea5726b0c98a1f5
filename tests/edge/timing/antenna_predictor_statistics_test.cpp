// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "edge/timing/antenna_predictor.h"
#include "tests/edge/timing/coverage.h"
#include "tests/edge/timing/simulated_climb.h"

namespace plumbline::timing {
namespace {

const Eigen::Vector3d kSigma_m{0.01, 0.01, 0.02};

// Two fifths of the variance are an offset, two fifths drift over 30 s, a fifth is white.
sim::GnssErrorSigmas error_sigmas() {
  const double large = std::sqrt(0.4);
  const double white = std::sqrt(0.2);
  sim::GnssErrorSigmas sigmas;
  sigmas.offset = {0.01 * large, 0.02 * large};
  sigmas.correlated = {0.01 * large, 0.02 * large};
  sigmas.white = {0.01 * white, 0.02 * white};
  return sigmas;
}

// One look per flight, `ahead_s` of the newest epoch, at an instant drawn for it.
Coverage coverage_of(double rate_hz, double climb_m_s, double ahead_s, int flights) {
  Coverage coverage;
  for (int flight = 0; flight < flights; ++flight) {
    sim::Random random(static_cast<std::uint64_t>(flight), 51);
    const SimulatedClimb climb(climb_m_s, 40, 0.5, random);
    std::vector<double> times_s;
    for (double t_s = random.uniform(); t_s < 20 + 10 * random.uniform(); t_s += 1 / rate_hz) {
      times_s.push_back(t_s);
    }
    const auto errors_m = sim::gnss_errors(error_sigmas(), times_s, random);
    AntennaPredictor predictor;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      predictor.add(fix_at(times_s[k], climb.at(times_s[k]) + errors_m[k], kSigma_m));
    }
    const double look_s = times_s.back() + ahead_s;
    const auto antenna = predictor.at(kGpsStart + of_seconds(look_s));
    if (!antenna) continue;
    const Eigen::Vector3d off_m = climb_frame().enu_of(antenna->position) - climb.at(look_s);
    coverage.add(off_m.z(), std::sqrt(antenna->covariance_enu_m2(2, 2)));
  }
  return coverage;
}

TEST(AntennaPredictorStatistics, CoversTheHeightOfClimbsWithStopsAndGusts) {
  if (PLUMBLINE_SANITIZED) GTEST_SKIP() << "statistics take too long under sanitizers";
  constexpr int kFlights = 200;
  std::puts("rate   climb  ahead (s)  rms, mean sigma of height (m)  within 1, 2 sigma (%)");
  for (const double rate_hz : {1.0, 5.0, 10.0}) {
    for (const double climb_m_s : {1.0, 3.0, 5.0}) {
      for (const double ahead_s : {-0.55, 0.1, 0.3, 0.5}) {
        const Coverage c = coverage_of(rate_hz, climb_m_s, ahead_s, kFlights);
        std::printf("%2.0f Hz  %g m/s  %5.2f  %7.4f %7.4f  %5.1f %5.1f\n", rate_hz, climb_m_s,
                    ahead_s, c.rms(), c.mean_sigma(), c.percent_in_one(), c.percent_in_two());
        ASSERT_EQ(c.count, kFlights);
        expect_covered(c);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::timing
