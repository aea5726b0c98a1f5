// SPDX-License-Identifier: MIT
// The delay between camera and GNSS, and the line time of a rolling shutter, as unknowns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edge/orient/adjust.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::MadeFlight;
using testing::make_flight;

constexpr int kFlights = 40;
// 99.9 % of chi-square with 40 degrees of freedom (tables), two-sided.
constexpr double kLow = 16.9, kHigh = 76.1;

// Squared errors in stated sigmas, and how many flights called it unobservable.
struct Found {
  double squares = 0, largest_sigma = 0;
  int declared = 0, missing = 0;

  void add(const std::optional<TimeEstimate>& estimate, double truth_s, bool is_declared) {
    if (!estimate) {
      ++missing;
      return;
    }
    squares += std::pow((estimate->seconds - truth_s) / estimate->sigma_s, 2);
    largest_sigma = std::max(largest_sigma, estimate->sigma_s);
    declared += is_declared ? 1 : 0;
  }
};

FlightPlan climb(std::vector<double> speeds_m_s) {
  FlightPlan plan;
  plan.heights_m = {30, 40, 50, 60, 70, 80, 90};
  plan.image_sigma_px = 0.1;
  plan.speeds_m_s = std::move(speeds_m_s);
  return plan;
}

Found delays(const FlightPlan& plan, double prior_s) {
  Found found;
  for (std::uint64_t seed = 900; seed < 900 + kFlights; ++seed) {
    MadeFlight flight = make_flight(plan, seed);
    flight.problem.delay = {0, prior_s};
    const auto solution = adjust(flight.problem, {});
    EXPECT_TRUE(solution) << solution.error().sentence;
    if (!solution) continue;
    found.add(solution->summary.delay, plan.delay_s,
              testing::calls_unobservable(solution->summary, "delay"));
  }
  return found;
}

TEST(Delay, IsFoundWhereTheSpeedVaries) {
  FlightPlan plan = climb({4, 0, 2});
  plan.delay_s = 0.05;
  const Found found = delays(plan, 0.1);
  EXPECT_EQ(found.missing, 0);
  EXPECT_EQ(found.declared, 0);
  EXPECT_LT(found.largest_sigma, 0.02);
  EXPECT_GT(found.squares, kLow);
  EXPECT_LT(found.squares, kHigh);
}

TEST(Delay, IsDeclaredUnobservableAtOneSpeed) {
  FlightPlan plan = climb({2});
  plan.delay_s = 0.05;
  const Found found = delays(plan, 0.1);
  EXPECT_EQ(found.missing, 0);
  EXPECT_EQ(found.declared, kFlights);
}

TEST(LineTime, IsFoundWhereTheSpeedVaries) {
  FlightPlan plan = climb({4, 0, -4});
  plan.line_time_s = 30e-6;
  Found found;
  for (std::uint64_t seed = 900; seed < 900 + kFlights; ++seed) {
    MadeFlight flight = make_flight(plan, seed);
    flight.problem.camera.line_time_us = 0;
    flight.problem.camera.line_time_sigma_us = 100;
    const auto solution = adjust(flight.problem, {});
    ASSERT_TRUE(solution) << solution.error().sentence;
    found.add(solution->summary.line_time, plan.line_time_s,
              testing::calls_unobservable(solution->summary, "line_time"));
  }
  EXPECT_EQ(found.missing, 0);
  EXPECT_EQ(found.declared, 0);
  EXPECT_LT(found.largest_sigma, 20e-6);
  EXPECT_GT(found.squares, kLow);
  EXPECT_LT(found.squares, kHigh);
}

}  // namespace
}  // namespace plumbline::orient
