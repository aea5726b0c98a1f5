// SPDX-License-Identifier: MIT
#include "edge/orient/network/normal_equations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/edge/orient/made/small_network.h"

namespace plumbline::orient {
namespace {

using testing::DenseSystem;
using testing::nudged;
using testing::SmallNetwork;

double step_of(int column) {
  const bool small = column > geometry::kPrincipalV && column < kShared;
  return small ? 1e-6 : 1e-4;
}

TEST(NormalEquations, LineariseARayByTrueDerivatives) {
  const SmallNetwork small(11);
  const RaysLinear rays = linearise_rays(small.network, small.state, 0);
  for (std::size_t k = 0; k < rays.rays.size(); k += 7) {
    const Ray& ray = small.network.rays[k];
    ASSERT_TRUE(rays.rays[k].active);
    for (int i = 0; i < kRayColumns; ++i) {
      const bool shared = i < kShared;
      if (shared && small.network.shared_mask[i] == 0) {
        EXPECT_EQ(rays.rays[k].by_common.col(i).norm(), 0);
        continue;
      }
      const int column = shared ? i : small.network.layout.photo(ray.slot) + i - kShared;
      const double h = step_of(column);
      const Eigen::Vector2d slope =
          (*residual_of(ray, nudged(small.network, small.state, column, h)) -
           *residual_of(ray, nudged(small.network, small.state, column, -h))) /
          (2 * h);
      EXPECT_LT((slope - rays.rays[k].by_common.col(i)).norm(), 1e-5 * (1 + slope.norm())) << i;
    }
    for (int i = 0; i < 3; ++i) {
      State after = small.state, before = small.state;
      after.points[at(ray.point)][i] += 1e-4;
      before.points[at(ray.point)][i] -= 1e-4;
      const Eigen::Vector2d slope = (*residual_of(ray, after) - *residual_of(ray, before)) / 2e-4;
      EXPECT_LT((slope - rays.rays[k].by_point.col(i)).norm(), 1e-5 * (1 + slope.norm()));
    }
  }
}

void expect_same_step(const SmallNetwork& small, double cauchy_scale) {
  const RaysLinear rays = linearise_rays(small.network, small.state, cauchy_scale);
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  const auto step = solve(normal_equations(small.network, small.state, cauchy_scale, terms), 0);
  ASSERT_TRUE(step);
  const Step dense = DenseSystem(small.network, rays.rays, terms).step();
  for (Eigen::Index c = 0; c < step->common.size(); ++c) {
    EXPECT_NEAR(step->common[c], dense.common[c], 1e-6 * (1e-3 + std::abs(dense.common[c]))) << c;
  }
  for (std::size_t p = 0; p < step->points.size(); ++p) {
    EXPECT_LT((step->points[p] - dense.points[p]).norm(), 1e-6 * (1e-3 + dense.points[p].norm()));
  }
}

TEST(NormalEquations, GiveTheStepOfTheSystemWithoutElimination) {
  for (const std::uint64_t seed : {12U, 13U}) {
    const SmallNetwork small(seed);
    EXPECT_EQ(small.network.layout.kept.size(), 3U);
    EXPECT_EQ(small.network.shared_mask[geometry::kAffinity], 0);
    EXPECT_EQ(small.network.shared_mask[kLineTime], 1);
    expect_same_step(small, 0);
    expect_same_step(small, 2.5);
  }
}

TEST(NormalEquations, TellTheSlopeAlongAStep) {
  const SmallNetwork small(12);
  const auto terms = linearised_terms(small.network, small.state, small.datum, small.options);
  const auto equations = normal_equations(small.network, small.state, 0, terms);
  const auto cost = [&](const State& state) {
    return cost_of(small.network, bundles_of(small.network), state, 0) +
           cost_of(linearised_terms(small.network, state, small.datum, small.options));
  };
  const Step step = *solve(equations, 1e-3);
  const double slope = slope_along(equations, step);
  constexpr double kShare = 1e-6;
  const double change = cost(moved_by(small.network, small.state, scaled(step, kShare))) -
                        cost(moved_by(small.network, small.state, scaled(step, -kShare)));
  EXPECT_LT(slope, 0);
  EXPECT_NEAR(change / (4 * kShare), slope, 1e-4 * std::abs(slope));
}

TEST(NormalEquations, GiveThatStepWithRaysRejectedAndTiesWidened) {
  SmallNetwork small(14);
  small.network.rays[3].used = false;
  small.network.rays[17].used = false;
  for (Ray& ray : small.network.rays) ray.group = ImageGroup::kTies;
  small.network.ties_design_effect = 2.5;
  expect_same_step(small, 0);
}

// A point behind one camera must not put the derivatives of the next photo into that camera's rows.
TEST(NormalEquations, GiveThatStepWithARayThatCannotBeProjected) {
  SmallNetwork small(15);
  const Ray& lost = small.network.rays[at(small.network.first_ray[0])];
  ASSERT_GE(used_rays(small.network, 0), 3);
  geometry::Pose& pose = small.state.poses[at(lost.slot)];
  pose.centre_m.z() = small.state.points[0].z() - 30;
  for (Ray& ray : small.network.rays) {
    if (ray.slot == lost.slot && ray.point != 0) ray.used = false;
  }
  ASSERT_FALSE(residual_of(lost, small.state));
  expect_same_step(small, 0);
}

// More points than are worked on side by side, and more of those than go into one product.
TEST(NormalEquations, GiveThatStepOfManyPoints) { expect_same_step(SmallNetwork(17, 90), 2.5); }

// Each photo misses points of its own: groups of a few points, some of one.
void look_away(SmallNetwork& small) {
  std::erase_if(small.problem.observations, [](const Observation& o) {
    return (o.point + 2 * o.photo) % 5 == 0 || (o.photo == 1 && o.point % 3 == 0);
  });
  small.tie_again();
}

TEST(NormalEquations, GiveThatStepOfPointsSeenByDifferentPhotos) {
  SmallNetwork small(18, 24);
  look_away(small);
  ASSERT_GE(small.network.groups.size(), 6U);
  expect_same_step(small, 0);
}

TEST(NormalEquations, GiveThatStepOfPointsThatAPhotoSeesTwice) {
  SmallNetwork small(19, 12);
  for (const int point : {2, 3, 6}) {
    Observation again = small.problem.observations[at(point)];
    ASSERT_EQ(again.point, point);
    again.pixel += Eigen::Vector2d(0.4, -0.2);
    again.sigma_px *= 1.5;
    small.problem.observations.push_back(again);
  }
  small.tie_again();
  expect_same_step(small, 0);
  expect_same_step(small, 2.5);
}

TEST(NormalEquations, TakeEachRowFromWhereTheCameraWasByThen) {
  SmallNetwork small(20);
  small.state.line_time_s = 100e-6;
  const Ray& ray = small.network.rays[4];
  const double rows = ray.pixel.y() - (small.problem.camera.height_px - 1) / 2.0;
  State moved = small.state, still = small.state;
  moved.line_time_s = still.line_time_s = 0;
  moved.poses[at(ray.slot)].centre_m +=
      100e-6 * rows * *small.network.photo(ray.slot).velocity_in_enu_m_s;
  const Eigen::Vector2d residual = *residual_of(ray, small.state);
  EXPECT_LT((residual - *residual_of(ray, moved)).norm(), 1e-9);
  EXPECT_GT((residual - *residual_of(ray, still)).norm(), 0.1);
}

TEST(NormalEquations, CostWhatTheResidualsOfTheRaysSay) {
  SmallNetwork small(27, 20);
  small.network.rays[7].used = false;
  for (const double scale : {0.0, 2.5}) {
    double expected = 0;
    for (const Ray& ray : small.network.rays) {
      if (!ray.used) continue;
      const double s2 =
          residual_of(ray, small.state)->squaredNorm() / (ray.sigma_px * ray.sigma_px);
      expected += scale == 0 ? s2 : scale * scale * std::log1p(s2 / (scale * scale));
    }
    const Bundles bundles = bundles_of(small.network);
    const double cost = cost_of(small.network, bundles, small.state, scale);
    EXPECT_NEAR(cost, expected, 1e-9 * expected);
    EXPECT_NEAR(linearise_rays(small.network, small.state, scale).cost, expected, 1e-9 * expected);
  }
}

double robust_cost(const SmallNetwork& small, const State& state, double scale) {
  return linearise_rays(small.network, state, scale).cost;
}

TEST(NormalEquations, WeighRaysAsTheRobustCostFalls) {
  const SmallNetwork small(16);
  constexpr double kScale = 2.5;
  const RaysLinear rays = linearise_rays(small.network, small.state, kScale);
  const DenseSystem system(small.network, rays.rays, {});
  for (int column = 0; column < small.network.layout.columns(); ++column) {
    if (column < kShared && small.network.shared_mask[column] == 0) continue;
    const double h = 0.01 * step_of(column);
    const double slope =
        (robust_cost(small, nudged(small.network, small.state, column, h), kScale) -
         robust_cost(small, nudged(small.network, small.state, column, -h), kScale)) /
        (2 * h);
    const double stated = 2 * system.gradient()[column];
    EXPECT_NEAR(stated, slope, 1e-4 * std::abs(stated) + 1e-2) << column;
  }
}

}  // namespace
}  // namespace plumbline::orient
