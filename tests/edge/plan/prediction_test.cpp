// SPDX-License-Identifier: MIT
#include "edge/plan/prediction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edge/geometry/standard_accuracy.h"
#include "tests/edge/plan/paper_camera.h"

namespace plumbline::plan {
namespace {

using testing::paper_options;

Prediction predicted(const Climb& climb, const Options& options,
                     Detail detail = Detail::kRepresentative) {
  const auto prediction = predict(flight_of(climb), options, detail);
  EXPECT_TRUE(prediction.ok());
  return prediction ? *prediction : Prediction{};
}

bool names(const Prediction& prediction, const std::string& name) {
  for (const auto& item : prediction.unobservable) {
    if (item.name == name) return true;
  }
  return false;
}

TEST(Prediction, KnowsNoAzimuthOfAStraightClimb) {
  const Prediction prediction = predicted({70, 90, 5, {}}, paper_options(0.3));
  EXPECT_FALSE(prediction.azimuth_deg);
  EXPECT_TRUE(names(prediction, "azimuth"));
  EXPECT_FALSE(prediction.rings[3].sigma.absolute.plan_m);
  EXPECT_TRUE(prediction.rings[3].sigma.absolute.height_m);
  EXPECT_TRUE(prediction.rings[3].sigma.local.plan_m);
}

TEST(Prediction, KnowsTheAzimuthOfAStraightClimbAsItsCompassDoes) {
  Options options = paper_options(0.3);
  options.heading_sigma_deg = 1;
  const auto azimuth = predicted({70, 90, 5, {}}, options).azimuth_deg;
  ASSERT_TRUE(azimuth);
  EXPECT_NEAR(*azimuth, 1, 0.05);
}

TEST(Prediction, SeesTheFootOfAClimbOnlyFromAside) {
  const Prediction pure = predicted({70, 90, 5, {}}, paper_options(0.3));
  EXPECT_FALSE(pure.foot.local.height_m);
  EXPECT_TRUE(names(pure, "height_at_foot"));
  const Prediction aside = predicted({70, 90, 5, {10}}, paper_options(0.3));
  EXPECT_TRUE(aside.foot.local.height_m);
  EXPECT_FALSE(names(aside, "height_at_foot"));
}

// The formula holds an orientation for known. Beyond the middle of the ground the orientation's
// own part, which the formula leaves out, grows.
TEST(Prediction, HasHeightsOfAPureClimbByTheFormulaOfOneLine) {
  const Prediction prediction = predicted({70, 90, 5, {}}, paper_options(0.3));
  for (int k = 1; k < 5; ++k) {
    const RingSigma& ring = prediction.rings[static_cast<std::size_t>(k)];
    ASSERT_TRUE(ring.climb_formula_height_m);
    EXPECT_NEAR(*ring.sigma.local.height_m / *ring.climb_formula_height_m, 1, 0.07);
  }
}

// Two photos side by side with everything known: the case of eq. 6, whose height takes the mean of
// the two rays' noise for plan.
TEST(Prediction, HasTheStandardAccuracyOfTwoPhotosSideBySide) {
  Options options = paper_options(0.3);
  options.camera.sigma.setZero();
  options.tilt_deg = 0;
  options.relief_m = 0;
  options.ties = 200'000;
  options.radius_m = 5;
  Flight flight;
  flight.foot_m = Eigen::Vector2d(0, 0);
  flight.ahead_m = {{-10, 0, 80}, {10, 0, 80}};
  const auto prediction = predict(flight, options, Detail::kRepresentative);
  ASSERT_TRUE(prediction);
  const auto standard = geometry::standard_accuracy(80, 20, 2125, 0.3);
  EXPECT_NEAR(*prediction->foot.local.height_m / standard.height_m, 1, 0.02);
  EXPECT_NEAR(*prediction->foot.local.plan_m * std::sqrt(2.0) / standard.plan_m, 1, 0.02);
}

TEST(Prediction, IsTheSameWithRepresentativeTiesAsWithAll) {
  for (const Climb& climb : {Climb{70, 90, 5, {}}, Climb{70, 90, 5, {5}}, Climb{30, 90, 5, {10}},
                             Climb{10, 60, 2.5, {5}}}) {
    const Prediction few = predicted(climb, paper_options(0.2));
    const Prediction all = predicted(climb, paper_options(0.2), Detail::kAll);
    ASSERT_EQ(few.rings.size(), all.rings.size());
    for (std::size_t k = 0; k < few.rings.size(); ++k) {
      const GroundSigma &a = few.rings[k].sigma, &b = all.rings[k].sigma;
      EXPECT_NEAR(*a.local.plan_m / *b.local.plan_m, 1, 0.03);
      EXPECT_NEAR(*a.local.height_m / *b.local.height_m, 1, 0.03);
      EXPECT_NEAR(*a.absolute.height_m / *b.absolute.height_m, 1, 0.03);
      if (b.absolute.plan_m) {
        EXPECT_NEAR(*a.absolute.plan_m / *b.absolute.plan_m, 1, 0.03);
      }
    }
    EXPECT_NEAR(few.focal_length_px / all.focal_length_px, 1, 0.02);
    if (all.azimuth_deg) {
      EXPECT_NEAR(*few.azimuth_deg / *all.azimuth_deg, 1, 0.02);
    }
  }
}

TEST(Prediction, HasLocalSigmasAloneWithoutPositions) {
  Options options = paper_options(0.2);
  options.rtk.reset();
  const Prediction prediction = predicted({70, 90, 5, {10}}, options);
  EXPECT_FALSE(prediction.georeferenced);
  EXPECT_FALSE(prediction.scale);
  EXPECT_FALSE(prediction.position_m);
  for (const RingSigma& ring : prediction.rings) {
    EXPECT_TRUE(ring.sigma.local.height_m);
    EXPECT_FALSE(ring.sigma.absolute.plan_m);
    EXPECT_FALSE(ring.sigma.absolute.height_m);
  }
}

// A length so poor that nothing else matters beside it.
TEST(Prediction, TakesScaleFromAKnownLength) {
  Options options = paper_options(0.2);
  options.rtk.reset();
  options.known_length_m = 30;
  options.length_sigma_m = 0.3;
  const auto scale = predicted({70, 90, 5, {10}}, options).scale;
  ASSERT_TRUE(scale);
  EXPECT_NEAR(*scale, 0.01, 0.0002);
}

TEST(Prediction, LosesNothingByOneMoreThingKnown) {
  const Climb climb{70, 90, 5, {5}};
  const Prediction before = predicted(climb, paper_options(0.2));
  Options more = paper_options(0.2);
  more.control_points = 1;
  more.known_length_m = 20;
  more.heading_sigma_deg = 1;
  const Prediction after = predicted(climb, more);
  for (std::size_t k = 0; k < before.rings.size(); ++k) {
    EXPECT_LE(*after.rings[k].sigma.absolute.plan_m, *before.rings[k].sigma.absolute.plan_m);
    EXPECT_LE(*after.rings[k].sigma.absolute.height_m, *before.rings[k].sigma.absolute.height_m);
  }
}

TEST(Prediction, HasNoFigureForGroundThatNobodySees) {
  Options options = paper_options(0.2);
  options.radius_m = 500;
  const Prediction prediction = predicted({70, 90, 5, {10}}, options);
  EXPECT_EQ(prediction.rings.back().seen, 0);
  EXPECT_FALSE(prediction.rings.back().sigma.local.height_m);
  EXPECT_FALSE(worst_ring(prediction).height_m);
}

TEST(Prediction, RefusesAFlightOfOnePhoto) {
  EXPECT_FALSE(predict(flight_of({80, 80, 5, {}}), paper_options(0.2), Detail::kAll));
}

}  // namespace
}  // namespace plumbline::plan
