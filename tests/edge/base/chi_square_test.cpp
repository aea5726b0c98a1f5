// SPDX-License-Identifier: MIT
#include "edge/base/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumbline {
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

double normal_share_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// With one degree of freedom, a shifted normal squared.
TEST(ChiSquare, NoncentralIsAShiftedNormalForOneDegreeOfFreedom) {
  for (const double shift : {0.0, 0.5, 4.13, 12.0})
    for (const double value : {0.2, 10.83, 60.0}) {
      const double root = std::sqrt(value);
      EXPECT_NEAR(noncentral_chi_square_share_below(value, 1, shift * shift),
                  normal_share_below(root - shift) - normal_share_below(-root - shift), 1e-10);
    }
}

// With three, the same plus an exponential of mean two, integrated by the midpoint rule.
TEST(ChiSquare, NoncentralAgreesWithItsConvolutionForThreeDegreesOfFreedom) {
  const double value = 17, lambda = 39, shift = std::sqrt(lambda), reach = std::sqrt(value);
  const int steps = 200000;
  double share = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = -reach + 2 * reach * (i + 0.5) / steps;
    const double density =
        std::exp(-0.5 * (z - shift) * (z - shift)) / std::sqrt(2 * std::numbers::pi);
    share += density * (1 - std::exp(-0.5 * (value - z * z))) * 2 * reach / steps;
  }
  EXPECT_NEAR(noncentral_chi_square_share_below(value, 3, lambda), share, 1e-9);
}

// W. Baarda, A testing procedure for use in geodetic networks (1968): lambda_0 = 17.075 for one
// degree of freedom, 0.1 % and a power of 80 %.
TEST(ChiSquare, GivesBaardasNoncentrality) {
  EXPECT_NEAR(noncentrality_for_power(chi_square_quantile(0.999, 1), 1, 0.8), 17.075, 1e-3);
}

// Two degrees of freedom: exp(-x / 2) exactly; one: the complementary error function.
TEST(ChiSquare, KnowsTheLogarithmOfTailsTooThinForADouble) {
  for (const double value : {0.5, 3.0, 50.0, 1e4})
    EXPECT_NEAR(chi_square_log_share_above(value, 2), -0.5 * value, 1e-12 * value + 1e-13);
  EXPECT_NEAR(chi_square_log_share_above(900, 1), std::log(std::erfc(std::sqrt(450.0))), 1e-9);
}

}  // namespace
}  // namespace plumbline
