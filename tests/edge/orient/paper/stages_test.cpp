// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "edge/geometry/rotation.h"
#include "edge/orient/paper/coplanarity.h"
#include "edge/orient/paper/heights.h"
#include "edge/orient/paper/procedure.h"
#include "tests/edge/orient/paper/test_field.h"

namespace plumbline::orient::paper {
namespace {

using testing::FieldPlan;
using testing::make_test_field;
using testing::TestField;

PairObservation some_pair() { return {{2900, 700}, {2761.5, 655.2}, 0.5, 0.7}; }

geometry::Pose some_pose() {
  return {{0.8, -0.5, 6}, geometry::ground_from_photo({0.02, -0.03, 0.1})};
}

geometry::InteriorVector some_camera() {
  geometry::InteriorVector c;
  c << 2125, 2004, 1119, 1e-3, -5e-4, -0.02, 0.01, 0, 2e-4, -1e-4;
  return c;
}

// The determinant's derivatives are those of the residual where the condition is fulfilled; a
// pixel moved onto its epipolar line makes it so.
TEST(Coplanarity, HasTheDerivativesThatNumbersGive) {
  PairObservation seen = some_pair();
  for (int i = 0; i < 60; ++i) {
    const double miss = coplanarity(some_camera(), some_pose(), seen)->residual;
    PairObservation moved = seen;
    moved.pixel_i.x() += 1e-3;
    const double slope = (coplanarity(some_camera(), some_pose(), moved)->residual - miss) / 1e-3;
    seen.pixel_i.x() -= miss / slope;
  }
  const auto at = coplanarity(some_camera(), some_pose(), seen);
  ASSERT_TRUE(at);
  ASSERT_NEAR(at->residual, 0, 1e-6);
  for (int i = 0; i < geometry::kInteriorCount; ++i) {
    const double h = i < 3 ? 1e-3 : 1e-6;
    geometry::InteriorVector plus = some_camera(), minus = plus;
    plus[i] += h;
    minus[i] -= h;
    const double slope = (coplanarity(plus, some_pose(), seen)->residual -
                          coplanarity(minus, some_pose(), seen)->residual) /
                         (2 * h);
    EXPECT_NEAR(at->by_interior[i], slope, 1e-4 * (1 + std::abs(slope))) << i;
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d h = 1e-6 * Eigen::Vector3d::Unit(i);
    geometry::Pose plus = some_pose(), minus = plus;
    plus.ground_from_photo = geometry::rotation_by(h) * plus.ground_from_photo;
    minus.ground_from_photo = geometry::rotation_by(-h) * minus.ground_from_photo;
    double slope = (coplanarity(some_camera(), plus, seen)->residual -
                    coplanarity(some_camera(), minus, seen)->residual) /
                   2e-6;
    EXPECT_NEAR(at->by_rotation[i], slope, 1e-4 * (1 + std::abs(slope)));
    plus = minus = some_pose();
    plus.centre_m += h;
    minus.centre_m -= h;
    slope = (coplanarity(some_camera(), plus, seen)->residual -
             coplanarity(some_camera(), minus, seen)->residual) /
            2e-6;
    EXPECT_NEAR(at->by_base[i], slope, 1e-4 * (1 + std::abs(slope)));
  }
}

// 14.831 m seen as 420 px through f = 2125 px is 75.038 m away; 400 px, 78.790 m.
TEST(PaperHeights, FollowEquations1And2) {
  Problem problem;
  problem.camera.interior << 2125, 1999.5, 1124.5, 0, 0, 0, 0, 0, 0, 0;
  problem.point_names = {"27", "35"};
  problem.photos.resize(2);
  problem.observations = {
      {0, 0, {1000, 1000}}, {0, 1, {1400, 1000}}, {1, 0, {1000, 1000}}, {1, 1, {1000, 1420}}};
  const auto heights = heights_from(problem, {0, 1, 14.831, 0.001});
  ASSERT_TRUE(heights.ok());
  EXPECT_EQ(heights->lowest, 1);
  EXPECT_NEAR(heights->height_m[1], 75.0378, 1e-4);
  EXPECT_NEAR(heights->base_z_m[0], 3.7519, 1e-4);
}

// Without noise and relief, and with the camera known, every stage finds the truth.
TEST(PaperProcedure, FindsTheTruthWhereThereIsNoNoise) {
  FieldPlan plan;
  plan.image_sigma_px = 1e-4;
  plan.relief_m = 1e-6;
  plan.priors.focal_length = plan.priors.principal_point = 1e-9;
  plan.priors.affinity = plan.priors.radial = plan.priors.tangential = 1e-9;
  const TestField field = make_test_field(plan, 3);
  const auto done = run_procedure(field.problem, field.roles, plan.priors, {});
  ASSERT_TRUE(done.ok()) << done.error().sentence;
  EXPECT_TRUE(done->relative.converged && done->intersection.converged);
  EXPECT_TRUE(done->resection.converged && done->adjusted.converged);
  EXPECT_EQ(done->relative.conditions, 39 * 4);
  EXPECT_EQ(done->relative.unknowns, 30);
  for (std::size_t p = 0; p < field.points.size(); ++p)
    EXPECT_LT((done->solution.points[p].in_enu_m - field.points[p]).norm(), 2e-3) << p;
  for (std::size_t i = 0; i < field.poses.size(); ++i)
    EXPECT_LT((done->adjusted.poses[i].centre_m - field.poses[i].centre_m).norm(), 0.1) << i;
}

TEST(PaperProcedure, StatesItsPriors) {
  const TestField field = make_test_field({}, 1);
  const auto done = run_procedure(field.problem, field.roles, {}, {});
  ASSERT_TRUE(done.ok());
  for (const char* words : {"ground flat to 0.3 m", "f to 1 %", "tilts within 5 degrees"})
    EXPECT_NE(done->declared.find(words), std::string::npos) << done->declared;
  EXPECT_TRUE(done->solution.points[0].covariance_m2.isZero(0));
}

TEST(PaperProcedure, SaysWhatItMisses) {
  TestField field = make_test_field({}, 1);
  const auto sentence = [&](const Problem& problem, const FrameRoles& roles) {
    const auto done = run_procedure(problem, roles, {}, {});
    return done ? std::string() : done.error().sentence;
  };
  Problem without = field.problem;
  without.lengths.clear();
  EXPECT_NE(sentence(without, field.roles).find("lengths.csv"), std::string::npos);
  Problem unseen = field.problem;
  std::erase_if(unseen.observations,
                [](const Observation& o) { return o.photo == 2 && o.point == 1; });
  EXPECT_NE(sentence(unseen, field.roles).find("Photo 80m does not show"), std::string::npos);
  Problem few = field.problem;
  std::erase_if(few.observations, [](const Observation& o) { return o.photo == 3 && o.point > 3; });
  EXPECT_NE(sentence(few, field.roles).find("shares only 4 points"), std::string::npos);
}

TEST(PaperProcedure, IsAPureFunctionOfItsInput) {
  const TestField field = make_test_field({}, 5);
  const auto a = run_procedure(field.problem, field.roles, {}, {});
  const auto b = run_procedure(field.problem, field.roles, {}, {});
  ASSERT_TRUE(a.ok() && b.ok());
  for (std::size_t p = 0; p < field.points.size(); ++p) {
    EXPECT_EQ(a->solution.points[p].in_enu_m, b->solution.points[p].in_enu_m);
    EXPECT_EQ(a->solution.points[p].covariance_m2, b->solution.points[p].covariance_m2);
  }
}

}  // namespace
}  // namespace plumbline::orient::paper
