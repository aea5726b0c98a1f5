// SPDX-License-Identifier: MIT
#include "edge/orient/network/terms.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <set>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "tests/edge/orient/made/small_network.h"

namespace plumbline::orient {
namespace {

using testing::nudged;
using testing::SmallNetwork;

// A step that moves angles, metres and pixels alike well above rounding.
double small_step_of(int column) {
  const bool small = column > geometry::kPrincipalV && column < kShared;
  return small ? 1e-6 : 1e-5;
}

void expect_true_jacobians(const SmallNetwork& small) {
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  for (int column = 0; column < small.network.layout.columns(); ++column) {
    if (column < kShared && small.network.shared_mask[column] == 0) continue;  // held fixed
    const double h = small_step_of(column);
    const auto after = linearised_terms(
        small.network, nudged(small.network, small.state, column, h), small.datum, small.options);
    const auto before = linearised_terms(
        small.network, nudged(small.network, small.state, column, -h), small.datum, small.options);
    for (std::size_t t = 0; t < terms.size(); ++t) {
      const Eigen::VectorXd slope = (after[t].residual - before[t].residual) / (2 * h);
      Eigen::VectorXd stated = Eigen::VectorXd::Zero(slope.size());
      for (std::size_t i = 0; i < terms[t].columns.size(); ++i) {
        if (terms[t].columns[i] == column)
          stated += terms[t].jacobian.col(static_cast<Eigen::Index>(i));
      }
      EXPECT_LT((slope - stated).cwiseAbs().maxCoeff(), 1e-6 * (1 + stated.norm()))
          << terms[t].group << " by column " << column;
    }
  }
}

std::set<std::string> groups(const SmallNetwork& small) {
  std::set<std::string> names;
  for (const Term& term :
       linearised_terms(small.network, small.state, small.datum, small.options)) {
    names.insert(term.group);
  }
  return names;
}

TEST(Terms, HaveTrueDerivativesWhereEverythingIsKnown) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SmallNetwork small(seed);
    const std::set<std::string> all = {"attitude", "camera",  "control", "datum",
                                       "gnss",     "heading", "lengths"};
    EXPECT_EQ(groups(small), all);
    expect_true_jacobians(small);
  }
}

TEST(Terms, HaveTrueDerivativesWhereAPhotoLooksTheOtherWayRound) {
  SmallNetwork small(4);
  for (const double kappa : {-std::numbers::pi + 1e-3, std::numbers::pi - 1e-3}) {
    const Eigen::Matrix3d turned = geometry::ground_from_photo({0.08, -0.06, kappa});
    small.state.poses[0].ground_from_photo = turned;
    small.state.poses[2].ground_from_photo = turned;
    expect_true_jacobians(small);
  }
}

TEST(Terms, HaveTrueDerivativesByADelayThatIsFree) {
  SmallNetwork small(9);
  small.problem.delay = {0.1, 0.05};
  small.network.shared_mask[kDelay] = 1;
  EXPECT_TRUE(groups(small).contains("delay"));
  expect_true_jacobians(small);
}

TEST(Terms, HaveTrueDerivativesWhereNothingIsKnown) {
  SmallNetwork small(5);
  small.options.datum = Datum::kFree;
  small.options.bridle_interior = true;
  EXPECT_EQ(groups(small), (std::set<std::string>{"attitude", "camera", "datum"}));
  expect_true_jacobians(small);
}

TEST(Terms, MeasureAHeadingAcrossThePointWhereAnglesWrap) {
  SmallNetwork small(6);
  small.state.poses[0].ground_from_photo =
      geometry::ground_from_photo({0, 0, std::numbers::pi - 0.01});
  small.problem.photos[0].heading = HeadingPrior{std::numbers::pi - 0.02, 0.05};
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  const auto heading =
      std::find_if(terms.begin(), terms.end(), [](const Term& t) { return t.group == "heading"; });
  ASSERT_NE(heading, terms.end());
  EXPECT_NEAR(heading->residual[0], -0.03, 1e-9);
}

// Worked by hand for three photos at 0, 10 and 30 s.
TEST(Terms, CorrelateStationsByOffsetDriftAndLeverArm) {
  SmallNetwork small(7);
  Problem& problem = small.problem;
  const double times[] = {0, 10, 30};
  for (std::size_t i = 0; i < problem.photos.size(); ++i) {
    if (i >= 3) problem.photos[i].station.reset();
    if (i < 3) problem.photos[i].time_s = times[i];
    small.state.poses[i].ground_from_photo.setIdentity();
  }
  problem.photos[0].station->covariance_m2 = Eigen::Vector3d(1e-4, 4e-4, 9e-4).asDiagonal();
  small.state.poses[1].ground_from_photo =
      geometry::ground_from_photo({0, 0, std::numbers::pi / 2});
  problem.gnss = {0.5, 0.8, 20, 0.1, 0.2};
  problem.lever_arm.sigma_m = 0.03;
  const Eigen::MatrixXd c = station_covariance(small.network, small.state, small.options);
  ASSERT_EQ(c.rows(), 9);
  EXPECT_NEAR(c(0, 0), 0.25 + 0.01 + 9e-4 + 1e-4, 1e-7);
  EXPECT_NEAR(c(1, 1), 0.25 + 0.01 + 9e-4 + 4e-4, 1e-7);
  EXPECT_NEAR(c(2, 2), 0.64 + 0.04 + 9e-4 + 9e-4, 1e-7);
  // Photo 2 is turned by a quarter: only the lever arm's upward part stays in line with photo 1.
  EXPECT_NEAR(c(0, 3), 0.25 + 0.01 * std::exp(-0.5), 1e-9);
  EXPECT_NEAR(c(2, 5), 0.64 + 0.04 * std::exp(-0.5) + 9e-4, 1e-9);
  EXPECT_NEAR(c(0, 4), 9e-4, 1e-9);
  EXPECT_NEAR(c(1, 3), -9e-4, 1e-9);
  EXPECT_NEAR(c(0, 6), 0.25 + 0.01 * std::exp(-1.5) + 9e-4, 1e-9);
  EXPECT_NEAR(c(4, 7), 0.25 + 0.01 * std::exp(-1.0), 1e-9);
  EXPECT_LT((c - c.transpose()).norm(), 1e-15);
}

TEST(Terms, LeaveOutARejectedStationAndWidenADoubtedOne) {
  SmallNetwork small(8);
  small.problem.gnss = {};
  small.problem.lever_arm.sigma_m = 0;
  small.options.station_weights.assign(at(small.network.slots()), 1.0);
  small.options.station_weights[0] = 0;
  small.options.station_weights[1] = 0.25;
  const Eigen::MatrixXd c = station_covariance(small.network, small.state, small.options);
  ASSERT_EQ(c.rows(), 3 * (small.network.slots() - 1));
  EXPECT_NEAR(c(0, 0), 4 * 0.005 * 0.005, 1e-7);
  EXPECT_NEAR(c(3, 3), 0.005 * 0.005, 1e-7);
}

}  // namespace
}  // namespace plumbline::orient
