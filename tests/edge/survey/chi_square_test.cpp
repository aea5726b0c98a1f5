// SPDX-License-Identifier: MIT
#include "edge/survey/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::survey {
namespace {

// Percentage points as printed in Pearson and Hartley, Biometrika Tables for Statisticians,
// table 8, and in Abramowitz and Stegun, table 26.8.
TEST(ChiSquare, AgreesWithThePrintedTables) {
  EXPECT_NEAR(chi_square_quantile(0.995, 1), 7.87944, 5e-6);
  EXPECT_NEAR(chi_square_quantile(0.005, 1), 3.92704e-5, 5e-10);
  EXPECT_NEAR(chi_square_quantile(0.95, 3), 7.81473, 5e-6);
  EXPECT_NEAR(chi_square_quantile(0.005, 10), 2.15585, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.995, 10), 25.1882, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.005, 30), 13.7867, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.995, 30), 53.6720, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.005, 100), 67.3276, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.995, 100), 140.169, 5e-4);
}

// With two degrees of freedom the distribution is exponential, in closed form.
TEST(ChiSquare, IsExponentialForTwoDegreesOfFreedom) {
  for (const double value : {0.01, 0.5, 2.0, 7.0, 40.0})
    EXPECT_NEAR(chi_square_share_below(value, 2), 1.0 - std::exp(-0.5 * value), 1e-13);
}

// With one it is the square of a standard normal.
TEST(ChiSquare, IsTheErrorFunctionForOneDegreeOfFreedom) {
  for (const double value : {1e-6, 0.3, 1.0, 9.0, 30.0})
    EXPECT_NEAR(chi_square_share_below(value, 1), std::erf(std::sqrt(0.5 * value)), 1e-12);
}

TEST(ChiSquare, QuantileInvertsTheShareAlsoForThousandsOfDegreesOfFreedom) {
  for (const int dof : {1, 4, 117, 3000})
    for (const double share : {0.005, 0.5, 0.995})
      EXPECT_NEAR(chi_square_share_below(chi_square_quantile(share, dof), dof), share, 1e-8);
}

}  // namespace
}  // namespace plumbline::survey
