// SPDX-License-Identifier: MIT
#include "edge/orient/precision/point_twists.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "tests/edge/orient/made/small_network.h"

namespace plumbline::orient {
namespace {

// Where the used rays of a point meet best, by Gauss-Newton with derivatives taken numerically.
Eigen::Vector3d intersection(const Network& network, State state, int point) {
  const int first = network.first_ray[at(point)], last = network.first_ray[at(point) + 1];
  const auto residuals = [&] {
    Eigen::VectorXd out(2 * (last - first));
    for (int k = first; k < last; ++k) {
      const Ray& ray = network.rays[at(k)];
      out.segment<2>(2 * (k - first)) = *residual_of(ray, state) / ray.sigma_px;
    }
    return out;
  };
  Eigen::Vector3d& place = state.points[at(point)];
  for (int round = 0; round < 20; ++round) {
    const Eigen::VectorXd here = residuals();
    Eigen::MatrixXd slope(here.size(), 3);
    for (int i = 0; i < 3; ++i) {
      constexpr double kStepM = 1e-3;
      place[i] += kStepM;
      slope.col(i) = residuals();
      place[i] -= 2 * kStepM;
      slope.col(i) = (slope.col(i) - residuals()) / (2 * kStepM);
      place[i] += kStepM;
    }
    place -= slope.colPivHouseholderQr().solve(here);
  }
  return place;
}

// The rays moved to where `state` sees its points.
Network seen_from(const State& state, Network network) {
  for (Ray& ray : network.rays) ray.pixel += *residual_of(ray, state);
  return network;
}

// Against the mixed second difference of where rays meet that met before the second direction was
// followed: what they miss each other by is noise, not part of what is asked.
TEST(PointTwists, AreTheMixedSecondDerivativesOfTheIntersections) {
  const testing::SmallNetwork small(5);
  const Network& network = small.network;
  const auto terms = linearised_terms(network, small.state, small.datum, small.options);
  const auto covariance =
      NetworkCovariance::of(network, normal_equations(network, small.state, 0, terms));
  ASSERT_TRUE(covariance);
  const auto directions = weak_directions(network, small.state, covariance->common());
  const auto sigma_along = [&](const WeakDirection& direction) {
    Step step{covariance->common() * direction.gradient / direction.sigma_rad, {}};
    step.points.assign(at(network.points()), Eigen::Vector3d::Zero());
    for (int p = 0; p < network.points(); ++p) {
      const PointFactor& factor = covariance->point(p);
      if (factor.measured) step.points[at(p)] = factor.by_common * step.common(factor.columns);
    }
    return step;
  };
  // Small steps of large sigmas, so that third derivatives do not count and no twist is left out.
  constexpr double kSmall = 0.01, kLarge = 1e5;
  const Step weak = scaled(sigma_along(directions[0]), kSmall);
  int compared = 0;
  for (const std::size_t k : {1U, 5U, 9U}) {
    const WeakDirection other{directions[k].gradient, directions[k].sigma_rad / kLarge};
    const auto twists = point_twists(network, small.state, *covariance, weak,
                                     kSmall * directions[0].sigma_rad, {other});
    ASSERT_EQ(twists.size(), 1U);
    EXPECT_EQ(twists[0].common.norm(), 0);
    const Step second = scaled(sigma_along(directions[k]), kSmall);
    for (int p = 0; p < network.points(); ++p) {
      if (network.layout.kept_of_point[at(p)] >= 0 || !covariance->point(p).measured) continue;
      Eigen::Vector3d mixed = Eigen::Vector3d::Zero();
      for (const double a : {1.0, -1.0}) {
        const State there = moved_by(network, small.state, scaled(weak, a));
        const Network seen = seen_from(there, network);
        for (const double b : {1.0, -1.0})
          mixed += a * b / 4 * intersection(seen, moved_by(network, there, scaled(second, b)), p);
      }
      mixed *= kLarge / kSmall;
      EXPECT_LT((twists[0].points[at(p)] - mixed).norm(), 0.01 * mixed.norm()) << k << ", " << p;
      ++compared;
    }
  }
  EXPECT_GT(compared, 15);
}

TEST(PointTwists, LeaveOutWhatIsNothingBesideAPointsOwnErrors) {
  const testing::SmallNetwork small(5);
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  const auto covariance =
      NetworkCovariance::of(small.network, normal_equations(small.network, small.state, 0, terms));
  ASSERT_TRUE(covariance);
  const auto directions = weak_directions(small.network, small.state, covariance->common());
  Step nowhere{Eigen::VectorXd::Zero(covariance->common().rows()), {}};
  nowhere.points.assign(at(small.network.points()), Eigen::Vector3d::Zero());
  EXPECT_TRUE(
      point_twists(small.network, small.state, *covariance, nowhere, 0.01, directions).empty());
}

}  // namespace
}  // namespace plumbline::orient
