// SPDX-License-Identifier: MIT
#include "edge/orient/precision/bent_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "edge/orient/adjust.h"
#include "edge/orient/network/term_parts.h"
#include "tests/edge/orient/made/made_flight.h"
#include "tests/edge/orient/made/small_network.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::make_flight;

Solution solved(const FlightPlan& plan, bool bent) {
  Options options;
  options.bent_error_bars = bent;
  auto solution = adjust(make_flight(plan, 21).problem, options);
  EXPECT_TRUE(solution) << solution.error().sentence;
  return solution ? *std::move(solution) : Solution{};
}

TEST(BentCovariance, IsTheStraightOneWhereAllIsKnownWell) {
  FlightPlan plan;
  plan.heights_m = {30, 45, 60, 75, 90};
  plan.side_step_m = plan.l_step_m = 20;
  plan.image_sigma_px = 0.1;
  plan.targets = 200;
  const Solution bent = solved(plan, true), straight = solved(plan, false);
  for (std::size_t p = 0; p < bent.points.size(); ++p) {
    if (!bent.points[p].measured) continue;
    const Eigen::Matrix3d& expected = straight.points[p].covariance_m2;
    EXPECT_LT((bent.points[p].covariance_m2 - expected).norm(), 0.01 * expected.norm()) << p;
  }
}

// Two stations almost above each other: their offset of 0.7 m, known to 5 mm, against tilts known
// to 2 degrees, which are 0.7 m over the climb of 20 m. The azimuth is anyone's guess.
TEST(BentCovariance, SaysThatTheAzimuthIsAnyonesGuess) {
  FlightPlan plan;
  plan.heights_m = {70, 90};
  plan.side_step_m = 0;
  plan.tilt_sigma_deg = 2;
  const CommonSigmas common = solved(plan, true).summary.common;
  EXPECT_GT(common.azimuth_rad, 0.5);
  EXPECT_LT(common.scale, 0.01) << "two RTK heights carry it, whatever the azimuth";
  EXPECT_LT(common.tilt_rad, 0.1);
}

// Where no place along a direction is within reach the straight bar must stay, not vanish.
TEST(BentCovariance, IsNeverLessThanAThirdOfTheStraightOne) {
  for (const double sigma_m : {0.05, 0.5, 5.0}) {
    FlightPlan plan;
    plan.heights_m = {70, 90};
    plan.side_step_m = 0;
    plan.tilt_sigma_deg = 2;
    plan.rtk_sigma_horizontal_m = plan.rtk_sigma_vertical_m = sigma_m;
    const Solution bent = solved(plan, true), straight = solved(plan, false);
    for (std::size_t p = 0; p < bent.points.size(); ++p) {
      if (!bent.points[p].measured) continue;
      EXPECT_TRUE(bent.points[p].covariance_m2.allFinite());
      EXPECT_GT(bent.points[p].covariance_m2.trace(), straight.points[p].covariance_m2.trace() / 3)
          << sigma_m << " m, point " << p;
    }
  }
}

TEST(BentCovariance, LeavesTheEstimateWhereItIs) {
  FlightPlan plan;
  plan.side_step_m = 0;
  const Solution bent = solved(plan, true), straight = solved(plan, false);
  for (std::size_t p = 0; p < bent.points.size(); ++p) {
    EXPECT_EQ(bent.points[p].in_enu_m, straight.points[p].in_enu_m);
  }
}

// A place is added as a variable of its own: the joint covariance of points is what its definition
// says.
TEST(NetworkCovariance, GrowsByTheSquareOfWhatBendsIt) {
  testing::SmallNetwork small(5);
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  auto covariance =
      NetworkCovariance::of(small.network, normal_equations(small.network, small.state, 0, terms));
  ASSERT_TRUE(covariance);
  Step step{Eigen::VectorXd::Zero(small.network.layout.columns()), {}};
  step.points.assign(at(small.network.points()), Eigen::Vector3d::Zero());
  std::vector<int> free_points;
  for (int p = 0; p < small.network.points(); ++p) {
    if (small.network.layout.kept_of_point[at(p)] >= 0 || !covariance->point(p).measured) continue;
    free_points.push_back(p);
    step.points[at(p)] = Eigen::Vector3d(0.1, -0.2, 0.05 * p);
  }
  step.common.segment<3>(small.network.layout.photo(1)).setConstant(0.03);
  const Eigen::MatrixXd before = covariance->joint(free_points);
  covariance->bend(0.25, step);
  Eigen::VectorXd moved(static_cast<Eigen::Index>(3 * free_points.size()));
  for (std::size_t k = 0; k < free_points.size(); ++k) {
    moved.segment<3>(static_cast<Eigen::Index>(3 * k)) = step.points[at(free_points[k])];
  }
  const Eigen::MatrixXd expected = before + 0.25 * moved * moved.transpose();
  EXPECT_LT((covariance->joint(free_points) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_LT(
      (covariance->point_covariances()[at(free_points[0])] - expected.topLeftCorner<3, 3>()).norm(),
      1e-9 * expected.norm());
}

// Twice the variance, of which half came of the second order: half of that half, a quarter of the
// whole, is to come of the next. The same variance, or half of it: left alone.
TEST(NetworkCovariance, AllowsForTheNextOrderAsTheLastWasToTheWhole) {
  const testing::SmallNetwork small(5);
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  const auto equations = normal_equations(small.network, small.state, 0, terms);
  const auto linear = NetworkCovariance::of(small.network, equations);
  ASSERT_TRUE(linear);
  const Eigen::MatrixXd reduced = reduced_matrix(equations, 0);
  for (const auto& [information, expected] :
       {std::pair{0.5, 2.5}, std::pair{1.0, 1.0}, std::pair{2.0, 0.5}}) {
    auto changed = linear->with_reduced(small.network, information * reduced);
    ASSERT_TRUE(changed);
    changed->add_next_order(*linear);
    const Eigen::MatrixXd difference = changed->common() - expected * linear->common();
    const Eigen::VectorXd sigma = linear->common().diagonal().cwiseSqrt();
    EXPECT_LT((difference.array().abs() - 1e-6 * (sigma * sigma.transpose()).array()).maxCoeff(),
              1e-12)
        << information;
  }
}

// The second moment of w x u by the axes of both ellipsoids, for independent w and u.
TEST(NetworkCovariance, TurnsThePointsOwnErrorsWithThePhotos) {
  testing::SmallNetwork small(5);
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  auto covariance =
      NetworkCovariance::of(small.network, normal_equations(small.network, small.state, 0, terms));
  ASSERT_TRUE(covariance);
  const NetworkCovariance before = *covariance;
  covariance->turn_own_parts(small.network);
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
  for (int p = 0; p < small.network.points(); ++p) {
    if (!before.point(p).measured) continue;
    Eigen::Matrix3d expected = before.point(p).own;
    const Solver own(before.point(p).own);
    const int rays = used_rays(small.network, p);
    for (int k = small.network.first_ray[at(p)]; k < small.network.first_ray[at(p) + 1]; ++k) {
      if (!small.network.rays[at(k)].used) continue;
      const int first = small.network.layout.photo(small.network.rays[at(k)].slot) + 3;
      const Solver turn(Eigen::Matrix3d(before.common().block<3, 3>(first, first)));
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const Eigen::Vector3d moved =
              Eigen::Vector3d(turn.eigenvectors().col(i)).cross(own.eigenvectors().col(j));
          expected +=
              turn.eigenvalues()[i] * own.eigenvalues()[j] / rays * moved * moved.transpose();
        }
      }
    }
    EXPECT_LT((covariance->point(p).own - expected).norm(), 1e-9 * expected.norm() + 1e-18) << p;
  }
}

}  // namespace
}  // namespace plumbline::orient
