// SPDX-License-Identifier: MIT
#include "edge/plan/flight.h"

#include <gtest/gtest.h>

namespace plumbline::plan {
namespace {

TEST(PlannedFlight, TakesAPhotoAtEveryStepAndAtTheTop) {
  const Flight flight = flight_of({70, 88, 5, {}});
  ASSERT_EQ(flight.photos(), 5U);
  EXPECT_EQ(flight.ahead_m[3].z(), 85);
  EXPECT_EQ(flight.ahead_m[4], Eigen::Vector3d(0, 0, 88));
}

TEST(PlannedFlight, TurnsEachSideStepByNinetyDegrees) {
  const Flight flight = flight_of({70, 90, 5, {10, 4}});
  ASSERT_EQ(flight.photos(), 7U);
  EXPECT_EQ(flight.ahead_m[5], Eigen::Vector3d(10, 0, 90));
  EXPECT_EQ(flight.ahead_m[6], Eigen::Vector3d(10, 4, 90));
}

TEST(PlannedFlight, TakesNoPhotoForASideStepOfNothing) {
  EXPECT_EQ(flight_of({70, 90, 5, {0}}).photos(), 5U);
}

TEST(PlannedFlight, HasTheNamedProfiles) {
  EXPECT_EQ(flight_of(*named_climb("paper")).photos(), 5U);
  EXPECT_EQ(flight_of(*named_climb("standard")).photos(), 14U);
  EXPECT_EQ(flight_of(*named_climb("ice")).photos(), 22U);
  EXPECT_FALSE(named_climb("other"));
}

TEST(PlannedFlight, HasItsFootBelowTheLineWhateverIsAside) {
  Flight flight = flight_of({70, 90, 5, {10, 10}});
  flight.taken_m = {{0.1, -0.1, 65}};
  EXPECT_LT(foot_of(flight).norm(), 0.2);
  EXPECT_EQ(highest_m(flight), 90);
  EXPECT_EQ(lowest_m(flight), 65);
  EXPECT_EQ(usual_step_m(flight), 5);
}

}  // namespace
}  // namespace plumbline::plan
