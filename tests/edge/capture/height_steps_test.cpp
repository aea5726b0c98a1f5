// SPDX-License-Identifier: MIT
#include "edge/capture/height_steps.h"

#include <gtest/gtest.h>

namespace plumbline::capture {
namespace {

HeightSteps steps_of(Direction direction) {
  CapturePlan plan;
  plan.heights_m = {30, 35, 40};
  plan.direction = direction;
  return HeightSteps(plan);
}

// The entry that is reached first between two heights is taken; its number, -1: none.
int take_between(HeightSteps& steps, double from_m, double to_m) {
  steps.look(from_m);
  const int entry = steps.first_between(from_m, to_m);
  steps.set_taken(entry, true);
  return entry;
}

TEST(HeightSteps, TakesEachHeightOnceOnTheWayUp) {
  HeightSteps steps = steps_of(Direction::kUp);
  EXPECT_EQ(take_between(steps, 29, 31), 0);
  EXPECT_EQ(take_between(steps, 31, 29), -1);  // bobbing
  EXPECT_EQ(take_between(steps, 29, 31), -1);
  EXPECT_EQ(take_between(steps, 34.9, 35.1), 1);
  EXPECT_EQ(take_between(steps, 39, 41), 2);
  EXPECT_EQ(take_between(steps, 41, 20), -1);
}

TEST(HeightSteps, TakesNothingOnTheWayUpWhereThePlanIsDown) {
  HeightSteps steps = steps_of(Direction::kDown);
  EXPECT_EQ(take_between(steps, 29, 31), -1);
  EXPECT_EQ(take_between(steps, 34, 36), -1);
  EXPECT_EQ(take_between(steps, 39, 43), -1);
  EXPECT_EQ(take_between(steps, 43, 39), 2);
  EXPECT_EQ(take_between(steps, 36, 34), 1);
  EXPECT_EQ(take_between(steps, 31, 29), 0);
}

// Entries 0 to 2 are upwards, 3 to 5 downwards.
TEST(HeightSteps, TakesEachHeightOnceInEitherDirection) {
  HeightSteps steps = steps_of(Direction::kBoth);
  EXPECT_EQ(take_between(steps, 29, 31), 0);
  EXPECT_EQ(take_between(steps, 34, 36), 1);
  EXPECT_EQ(take_between(steps, 39, 43), 2);
  EXPECT_EQ(take_between(steps, 43, 39), 5);
  EXPECT_EQ(take_between(steps, 36, 34), 4);
  EXPECT_EQ(take_between(steps, 31, 29), 3);
  for (const auto& entry : steps.entries()) EXPECT_TRUE(entry.taken);
}

// 0.5 m above a height is a bob, not the way down: that asks for more than 1 m.
TEST(HeightSteps, TakesNoBobForTheWayDown) {
  HeightSteps steps = steps_of(Direction::kBoth);
  EXPECT_EQ(take_between(steps, 29, 30.5), 0);
  EXPECT_EQ(take_between(steps, 30.5, 29.5), -1);
  steps.look(31.1);
  EXPECT_EQ(take_between(steps, 31.1, 29.5), 3);
}

TEST(HeightSteps, KeepsAHeightThatWentByForNow) {
  HeightSteps steps = steps_of(Direction::kUp);
  steps.look(31);
  EXPECT_EQ(steps.passed_at(31), 0);
  EXPECT_TRUE(steps.is_late(0, 31));
  EXPECT_FALSE(steps.is_late(0, 30.2));
  EXPECT_EQ(steps.passed_at(32.6), -1);           // nearer to 35 m
  EXPECT_EQ(take_between(steps, 30.5, 29.5), 0);  // and on the way down it is met again
}

TEST(HeightSteps, FindsTheHeightThatThePilotPausedAt) {
  const HeightSteps steps = steps_of(Direction::kUp);
  EXPECT_EQ(steps.near(34.6, 0.5), 1);
  EXPECT_EQ(steps.near(34.4, 0.5), -1);
}

TEST(HeightSteps, GoesOnAfterARestartWithWhatIsNotTaken) {
  HeightSteps steps = steps_of(Direction::kUp);
  steps.resume({1, 0});
  EXPECT_EQ(take_between(steps, 29, 31), -1);
  EXPECT_EQ(take_between(steps, 34, 36), 1);
  EXPECT_EQ(steps.taken(), (std::vector<std::uint8_t>{1, 1, 0}));
}

TEST(HeightSteps, OpensItsAimAgainWhenNoExposureCame) {
  HeightSteps steps = steps_of(Direction::kUp);
  EXPECT_EQ(take_between(steps, 29, 31), 0);
  steps.set_taken(0, false);
  EXPECT_EQ(take_between(steps, 29.5, 30.5), 0);
}

TEST(HeightSteps, KnowsTheLowest) {
  EXPECT_DOUBLE_EQ(steps_of(Direction::kBoth).lowest_m(), 30);
  EXPECT_FALSE(steps_of(Direction::kBoth).any_taken());
}

}  // namespace
}  // namespace plumbline::capture
