// SPDX-License-Identifier: MIT
#include "sim/gnss_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::sim {
namespace {

constexpr int kFlights = 40000;

// Mean products of the errors of two photos `apart_s` apart: (first first, first second), per axis.
struct Moments {
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  Eigen::Vector3d covariance = Eigen::Vector3d::Zero();
};

Moments moments(const GnssErrorSigmas& sigmas, double apart_s) {
  Random random(20260418, 1);
  Moments sums;
  for (int k = 0; k < kFlights; ++k) {
    const auto errors_m = gnss_errors(sigmas, {0, apart_s}, random);
    sums.variance += errors_m[0].cwiseAbs2() / kFlights;
    sums.covariance += errors_m[0].cwiseProduct(errors_m[1]) / kFlights;
  }
  return sums;
}

// The sample variance of 40000 draws scatters by 0.7 %: five times that.
constexpr double kScatter = 0.035;

TEST(GnssError, AddsTheVariancesOfItsThreeParts) {
  const GnssErrorSigmas sigmas{{0.3, 0.5}, {0.04, 0.08}, 30, {0.005, 0.010}};
  const Moments found = moments(sigmas, 10);
  const double plan_m2 = 0.3 * 0.3 + 0.04 * 0.04 + 0.005 * 0.005;
  const double height_m2 = 0.5 * 0.5 + 0.08 * 0.08 + 0.010 * 0.010;
  EXPECT_NEAR(found.variance.x() / plan_m2, 1, kScatter);
  EXPECT_NEAR(found.variance.y() / plan_m2, 1, kScatter);
  EXPECT_NEAR(found.variance.z() / height_m2, 1, kScatter);
}

TEST(GnssError, KeepsItsOffsetThroughTheFlight) {
  const Moments found = moments({{3, 5}, {0, 0}, 30, {0, 0}}, 600);
  EXPECT_NEAR(found.covariance.x() / 9, 1, kScatter);
  EXPECT_NEAR(found.covariance.z() / 25, 1, kScatter);
}

TEST(GnssError, ForgetsItsCorrelatedPartByTheTimeConstant) {
  for (const double apart_s : {3.0, 30.0, 90.0}) {
    const Moments found = moments({{0, 0}, {0.02, 0.04}, 30, {0, 0}}, apart_s);
    const double kept = std::exp(-apart_s / 30);
    EXPECT_NEAR(found.covariance.x() / (0.02 * 0.02), kept, kScatter);
    EXPECT_NEAR(found.covariance.z() / (0.04 * 0.04), kept, kScatter);
  }
}

TEST(GnssError, LeavesItsWhitePartUncorrelated) {
  const Moments found = moments({{0, 0}, {0, 0}, 30, {0.005, 0.010}}, 2.5);
  EXPECT_NEAR(found.variance.x() / (0.005 * 0.005), 1, kScatter);
  EXPECT_NEAR(found.covariance.x() / (0.005 * 0.005), 0, kScatter);
  EXPECT_NEAR(found.covariance.z() / (0.010 * 0.010), 0, kScatter);
}

}  // namespace
}  // namespace plumbline::sim
