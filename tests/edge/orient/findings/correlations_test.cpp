// SPDX-License-Identifier: MIT
#include "edge/orient/findings/correlations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edge/orient/adjust.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;

Summary summary_of(const FlightPlan& plan, double min_correlation = 0.9) {
  Options options;
  options.min_correlation = min_correlation;
  const auto solution = adjust(testing::make_flight(plan, 5).problem, options);
  EXPECT_TRUE(solution) << solution.error().sentence;
  return solution ? solution->summary : Summary{};
}

double correlation_of(const Summary& summary, const std::string& a, const std::string& b) {
  for (const Correlation& pair : summary.correlations) {
    if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) return pair.value;
  }
  return 0;
}

// Photos looking straight down at ground that is nearly flat see f over the flying height; of a
// camera known to 2 % and a height known to nobody the ratio alone is left.
TEST(Correlations, SayThatAScaleFromALengthLeavesFocalLengthAndHeightTogether) {
  FlightPlan plan;
  plan.stations = false;
  plan.known_length = true;
  plan.side_step_m = 0;
  plan.f_sigma = 0.02;
  const Summary summary = summary_of(plan, 0.5);
  EXPECT_GT(correlation_of(summary, "focal_length_px", "flying_height"), 0.8);
  for (const Correlation& pair : summary.correlations) {
    EXPECT_GT(std::abs(pair.value), 0.5);
    EXPECT_LE(std::abs(pair.value), 1.0);
    EXPECT_NE(pair.a, "azimuth") << "nothing gives one";
    EXPECT_NE(pair.b, "azimuth") << "nothing gives one";
  }
}

TEST(Correlations, AreThoseOfTheAdjustedCamera) {
  FlightPlan plan;
  plan.free_camera = true;
  plan.f_sigma = 0.02;
  Options options;
  options.min_correlation = 0.3;
  options.bent_error_bars = false;
  const auto solution = adjust(testing::make_flight(plan, 5).problem, options);
  ASSERT_TRUE(solution) << solution.error().sentence;
  const geometry::InteriorMatrix& c = *solution->camera.covariance;
  int compared = 0;
  for (const Correlation& pair : solution->summary.correlations) {
    const auto* const begin = geometry::kInteriorNames.begin();
    const auto* const end = geometry::kInteriorNames.end();
    const auto i = std::find(begin, end, pair.a) - begin, j = std::find(begin, end, pair.b) - begin;
    if (i == geometry::kInteriorCount || j == geometry::kInteriorCount) continue;
    EXPECT_NEAR(pair.value, c(i, j) / std::sqrt(c(i, i) * c(j, j)), 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

TEST(Correlations, AreSortedByStrength) {
  const Summary summary = summary_of({}, 0.5);
  ASSERT_GT(summary.correlations.size(), 1u);
  EXPECT_TRUE(std::is_sorted(
      summary.correlations.begin(), summary.correlations.end(),
      [](const auto& a, const auto& b) { return std::abs(a.value) > std::abs(b.value); }));
}

TEST(WeakestCombinations, NameTheAzimuthOfAPureClimb) {
  FlightPlan plan;
  plan.side_step_m = 0;
  const Summary summary = summary_of(plan);
  ASSERT_FALSE(summary.weakest.empty());
  const WeakCombination& worst = summary.weakest.front();
  const auto azimuth = std::find_if(worst.goes_with.begin(), worst.goes_with.end(),
                                    [](const auto& part) { return part.first == "azimuth"; });
  ASSERT_NE(azimuth, worst.goes_with.end());
  EXPECT_GT(std::abs(azimuth->second), 0.95);
  EXPECT_GT(worst.sigma_rad, summary.common.azimuth_rad);  // all photos turn by it
  EXPECT_GE(worst.sigma_rad, summary.weakest.back().sigma_rad);
}

}  // namespace
}  // namespace plumbline::orient
