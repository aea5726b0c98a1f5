// SPDX-License-Identifier: MIT
#include "edge/timing/floor_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/random.h"

namespace plumbline::timing {
namespace {

double exponential(sim::Random& random) { return -std::log(1 - random.uniform()); }

// The lowest of 100 delays of the law x^power on (0, 50 ms), ascending.
std::vector<double> lowest_delays_s(double power, std::size_t lowest, sim::Random& random) {
  std::vector<double> delays_s(100);
  for (double& delay : delays_s) delay = 50e-3 * std::pow(random.uniform(), 1 / power);
  std::sort(delays_s.begin(), delays_s.end());
  delays_s.resize(lowest);
  return delays_s;
}

std::vector<double> above_lowest(std::vector<double> delays_s) {
  const double lowest_s = delays_s.front();
  for (double& delay : delays_s) delay -= lowest_s;
  return delays_s;
}

// The posterior has a long tail to one side, so not the share within two sigmas but the mean square
// is what a standard deviation promises.
TEST(FloorGap, StatesTheStandardDeviationOfItsErrorForALawOfUnknownPower) {
  constexpr int kTrials = 2000;
  sim::Random random(1, 71);
  double sum = 0;
  double sum2 = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    // A power as it is thought to be before anything is seen: gamma, shape 3, mean 1.5.
    const double power = (exponential(random) + exponential(random) + exponential(random)) / 2;
    const auto delays_s = lowest_delays_s(power, 20, random);
    const FloorGap gap = floor_gap(above_lowest(delays_s));
    // Laws that crowd at their floor are known better than any clock: 0.1 ms are left to it.
    const double sigma_s = std::hypot(gap.sigma_s, 0.1e-3);
    const double square = std::pow((gap.mean_s - delays_s.front()) / sigma_s, 2);
    sum += square;
    sum2 += square * square;
  }
  const double mean = sum / kTrials;
  const double standard_error = std::sqrt((sum2 / kTrials - mean * mean) / kTrials);
  EXPECT_NEAR(mean, 1, 3 * standard_error);
}

TEST(FloorGap, IsWiderWhereTheLawBeginsMoreThinly) {
  sim::Random random(2, 71);
  double before_s = 0;
  for (const double power : {0.5, 1.0, 2.0, 3.0}) {
    double sigma_s = 0;
    for (int trial = 0; trial < 50; ++trial) {
      sigma_s += floor_gap(above_lowest(lowest_delays_s(power, 20, random))).sigma_s / 50;
    }
    EXPECT_GT(sigma_s, before_s) << power;
    before_s = sigma_s;
  }
}

TEST(FloorGap, OfOnePointIsWhatIsUsual) {
  const FloorGap gap = floor_gap(std::vector<double>{0});
  // An exponential prior of mean 20 ms: its mean is its sigma.
  EXPECT_NEAR(gap.mean_s, 20e-3, 0.5e-3);
  EXPECT_NEAR(gap.sigma_s, 20e-3, 0.5e-3);
}

TEST(FloorGap, OfEqualPointsIsNearlyNothing) {
  EXPECT_LT(floor_gap(std::vector<double>(10, 0.0)).mean_s, 0.1e-3);
}

}  // namespace
}  // namespace plumbline::timing
