// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::timing {

// Errors beside the sigmas that were stated for them, in one unit.
struct Coverage {
  int count = 0;
  int within_one = 0;
  int within_two = 0;
  double sum = 0;
  double sum2 = 0;
  double sum_sigma = 0;

  void add(double error, double sigma) {
    ++count;
    within_one += std::abs(error) <= sigma ? 1 : 0;
    within_two += std::abs(error) <= 2 * sigma ? 1 : 0;
    sum += error;
    sum2 += error * error;
    sum_sigma += sigma;
  }
  double rms() const { return std::sqrt(sum2 / count); }
  double mean() const { return sum / count; }
  double mean_sigma() const { return sum_sigma / count; }
  double percent_in_one() const { return 100.0 * within_one / count; }
  double percent_in_two() const { return 100.0 * within_two / count; }
};

// Coverage as the least that would be honest: 68.3 and 95.4 % less three binomial sigmas.
inline void expect_covered(const Coverage& coverage) {
  const double n = coverage.count;
  EXPECT_GE(coverage.within_one, 0.683 * n - 3 * std::sqrt(0.683 * 0.317 * n));
  EXPECT_GE(coverage.within_two, 0.954 * n - 3 * std::sqrt(0.954 * 0.046 * n));
}

}  // namespace plumbline::timing
