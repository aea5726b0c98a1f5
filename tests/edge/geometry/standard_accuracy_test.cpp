// SPDX-License-Identifier: MIT
#include "edge/geometry/standard_accuracy.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace plumbline::geometry {
namespace {

// Kunii and Kumazaki 2018, the row "standard accuracy" of their table of results.
TEST(StandardAccuracy, IsThatOfThePaper) {
  const StandardAccuracy accuracy = standard_accuracy(83.944, 20.137, 2125, 1);
  EXPECT_EQ(std::round(1000 * accuracy.plan_m), 40);
  EXPECT_EQ(std::round(1000 * accuracy.height_m), 233);
}

TEST(StandardAccuracy, GrowsWithTheImageNoise) {
  const StandardAccuracy one = standard_accuracy(80, 20, 2000, 1);
  const StandardAccuracy tenth = standard_accuracy(80, 20, 2000, 0.1);
  EXPECT_NEAR(tenth.plan_m, one.plan_m / 10, 1e-12);
  EXPECT_NEAR(tenth.height_m, one.height_m / 10, 1e-12);
}

TEST(StandardAccuracy, HasNoHeightWithoutABase) {
  EXPECT_TRUE(std::isinf(standard_accuracy(80, 0, 2000, 1).height_m));
}

// Radii f r / (H_i - Z) by (r, Z), inverted as they are.
double least_squares_height_m(const std::vector<double>& heights_m, double r, double f) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(heights_m.size()), 2);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const double h = heights_m[static_cast<std::size_t>(i)];
    a.row(i) << f / h, f * r / (h * h);
  }
  return std::sqrt((a.transpose() * a).inverse()(1, 1));
}

double relative_error(const std::vector<double>& heights_m, double r) {
  return climb_height_accuracy_m(heights_m, r, 2125, 1) /
             least_squares_height_m(heights_m, r, 2125) -
         1;
}

// What first order leaves out shrinks with the square of the climb.
TEST(ClimbHeightAccuracy, IsThatOfLeastSquaresToFirstOrderInTheClimb) {
  for (const double r : {2.0, 10.0, 25.0}) {
    const double whole = relative_error({70, 75, 80, 85, 90}, r);
    const double half = relative_error({75, 77.5, 80, 82.5, 85}, r);
    EXPECT_LT(std::abs(whole), 10 * 0.125 * 0.125);  // the climb is 1/8 of the height either way
    EXPECT_NEAR(half / whole, 0.25, 0.02);
  }
}

TEST(ClimbHeightAccuracy, HasNoBoundAtTheFootOrWithOneHeight) {
  EXPECT_TRUE(std::isinf(climb_height_accuracy_m({70, 90}, 0, 2125, 1)));
  EXPECT_TRUE(std::isinf(climb_height_accuracy_m({80}, 10, 2125, 1)));
  EXPECT_TRUE(std::isinf(climb_height_accuracy_m({}, 10, 2125, 1)));
}

}  // namespace
}  // namespace plumbline::geometry
