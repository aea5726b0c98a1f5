// SPDX-License-Identifier: MIT
// What is predicted beside what the adjustment states of measured flights.
#include <gtest/gtest.h>

#include <cmath>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/orient/adjust.h"
#include "edge/plan/model.h"
#include "edge/plan/prediction.h"
#include "tests/edge/orient/made/made_flight.h"
#include "tests/edge/plan/paper_camera.h"

namespace plumbline::plan {
namespace {

using orient::testing::FlightPlan;
using orient::testing::MadeFlight;
using testing::paper_options;

// Mean squares over the points of a solution, and over solutions.
struct Stated {
  double plan_m2 = 0, height_m2 = 0, local_plan_m2 = 0, local_height_m2 = 0;
  double azimuth_rad2 = 0, focal2 = 0;
  int solutions = 0;

  void add(const orient::Solution& solution) {
    const double share = 1.0 / static_cast<double>(solution.points.size());
    for (std::size_t p = 0; p < solution.points.size(); ++p) {
      const auto &c = solution.points[p].covariance_m2,
                 &local = solution.points[p].local_covariance_m2;
      plan_m2 += share * 0.5 * (c(0, 0) + c(1, 1));
      height_m2 += share * c(2, 2);
      local_plan_m2 += share * 0.5 * (local(0, 0) + local(1, 1));
      local_height_m2 += share * local(2, 2);
    }
    azimuth_rad2 += std::pow(solution.summary.common.azimuth_rad, 2);
    focal2 += std::pow(solution.summary.common.focal_length, 2);
    ++solutions;
  }
  double rms(double sum) const { return std::sqrt(sum / solutions); }
};

void expect_predicted(const Prediction& p, const Stated& s, double tolerance) {
  EXPECT_NEAR(*p.field.absolute.plan_m / s.rms(s.plan_m2), 1, tolerance);
  EXPECT_NEAR(*p.field.absolute.height_m / s.rms(s.height_m2), 1, tolerance);
  EXPECT_NEAR(*p.field.local.plan_m / s.rms(s.local_plan_m2), 1, tolerance);
  EXPECT_NEAR(*p.field.local.height_m / s.rms(s.local_height_m2), 1, tolerance);
  EXPECT_NEAR(*p.azimuth_deg * kRadPerDeg / s.rms(s.azimuth_rad2), 1, tolerance);
  EXPECT_NEAR(p.focal_length_px / 2125 / s.rms(s.focal2), 1, tolerance);
}

// The very observations of the model, without noise, with the weights that the ties have.
TEST(Adjustment, StatesWhatWasPredictedOfTheSameObservations) {
  for (const Climb& climb : {Climb{70, 90, 5, {10}}, Climb{30, 90, 5, {5, 5}}}) {
    Options options = paper_options(0.2);
    const Flight flight = flight_of(climb);
    Model model = model_of(flight, options, Detail::kRepresentative);
    std::size_t first = 1;
    while (model.points[first].ring >= 0) ++first;
    for (auto& o : model.problem.observations) {
      o.sigma_px /= std::sqrt(model.points[at(o.point)].ties);
    }
    const auto solution = orient::adjust(model.problem, options.adjustment);
    ASSERT_TRUE(solution) << solution.error().sentence;
    const auto prediction = predict(flight, options, Detail::kRepresentative);
    ASSERT_TRUE(prediction);
    EXPECT_NEAR(*prediction->azimuth_deg * kRadPerDeg / solution->summary.common.azimuth_rad, 1,
                0.005);
    EXPECT_NEAR(prediction->focal_length_px / 2125 / solution->summary.common.focal_length, 1,
                0.005);
  }
}

// Flights that were measured with noise, over targets that lie by chance where they do. The
// information of 39 targets about an azimuth scatters by some 15 % from field to field, a sigma by
// half as much, the mean of twelve fields by 2 %; that the mean of inverses is above the inverse
// of the mean makes 2 or 3 % more.
TEST(Adjustment, StatesWhatWasPredictedOfTheSameKindOfFlight) {
  for (const double side_step_m : {5.0, 10.0, 20.0}) {
    FlightPlan plan;
    plan.side_step_m = side_step_m;
    Options options = paper_options(plan.image_sigma_px);
    options.ties = plan.targets;
    options.tilt_deg = plan.tilt_sigma_deg;
    options.field_half_m = Eigen::Vector2d(20, 28);
    options.radius_m = 20;
    Stated stated;
    Flight flight;
    flight.foot_m = Eigen::Vector2d(0, 0);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const MadeFlight made = orient::testing::make_flight(plan, seed);
      const auto solution = orient::adjust(made.problem, options.adjustment);
      ASSERT_TRUE(solution) << solution.error().sentence;
      stated.add(*solution);
      flight.taken_m.clear();
      for (const auto& pose : made.poses) flight.taken_m.push_back(pose.centre_m);
    }
    const auto prediction = predict(flight, options, Detail::kRepresentative);
    ASSERT_TRUE(prediction);
    expect_predicted(*prediction, stated, 0.1);
  }
}

}  // namespace
}  // namespace plumbline::plan
