// SPDX-License-Identifier: MIT
// Where the ground is, and when the drone has left it: cases worked by hand.
#include "edge/capture/take_off.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::capture {
namespace {

using std::chrono::milliseconds;

HostTime at_s(double seconds) {
  return HostTime(std::chrono::nanoseconds(std::llround(1e9 * seconds)));
}

// Five fixes a second, from one time up to another, of a height that changes evenly.
struct Leg {
  double from_s = 0;
  double until_s = 0;
  double height_m = 0;  // at the start
  double climb_m_s = 0;
  double sigma_m = 0.02;
};

template <typename Watch>
void fly(Watch& watch, const Leg& leg) {
  const int fixes = static_cast<int>(std::lround(5 * (leg.until_s - leg.from_s)));
  for (int k = 0; k < fixes; ++k) {
    const double gone_s = 0.2 * k;
    watch.add({at_s(leg.from_s + gone_s), leg.height_m + leg.climb_m_s * gone_s, leg.sigma_m,
               leg.climb_m_s});
  }
}

TEST(Ground, IsTheFirstHeightUntilMoreIsKnown) {
  Ground ground;
  EXPECT_FALSE(ground.height_m());
  ground.add({at_s(0), 52.3, 0.02, 0});
  EXPECT_DOUBLE_EQ(*ground.height_m(), 52.3);
}

// Ten seconds at 52.0 and then ten at 52.1, within 0.3 m: once all thirteen seconds that are looked
// at but the last three are at 52.1, so is the ground.
TEST(Ground, FollowsWhatDrifts) {
  Ground ground;
  fly(ground, {0, 10, 52.0});
  fly(ground, {10, 26, 52.1});
  EXPECT_NEAR(*ground.height_m(), 52.1, 1e-9);
}

// Seconds 0 to 9 at 52.0, the climb of 2 m/s from second 10 on: none of it counts.
TEST(Ground, DoesNotRiseWithTheDrone) {
  Ground ground;
  fly(ground, {0, 10, 52.0});
  fly(ground, {10, 40, 52.0, 2});
  EXPECT_NEAR(*ground.height_m(), 52.0, 0.1);
}

// A restart 0.5 m above the ground, in the climb, and the first fixes know little: the last three
// seconds never count.
TEST(Ground, DoesNotRiseWithADroneThatWasRestartedInItsFirstMetre) {
  Ground ground;
  ground.set(52.0);
  fly(ground, {0, 1, 52.5, 2, 1.0});
  fly(ground, {1, 20, 54.5, 2});
  EXPECT_DOUBLE_EQ(*ground.height_m(), 52.0);
}

TEST(Ground, IsNotWhereTheDroneHoversForHalfAMinute) {
  Ground ground;
  fly(ground, {0, 10, 52.0});
  fly(ground, {10, 14, 52.0, 2});
  fly(ground, {14, 44, 60.0});
  EXPECT_NEAR(*ground.height_m(), 52.0, 0.1);
}

TEST(Ground, IsWhereItHasStoodForMoreThanAMinute) {
  Ground ground;
  fly(ground, {0, 10, 52.0});
  fly(ground, {10, 85, 60.0});
  EXPECT_NEAR(*ground.height_m(), 60.0, 1e-9);
}

TEST(Ground, FallsWithinSecondsWhereTheDroneStandsLower) {
  Ground ground;
  fly(ground, {0, 10, 52.0});
  fly(ground, {10, 17, 48.0});
  EXPECT_NEAR(*ground.height_m(), 48.0, 1e-9);
}

// 2 m/s: 3 m above after 1.5 s, and for 2 s after 3.5 s.
TEST(TakeOffWatch, AsksForThreeMetresForTwoSeconds) {
  TakeOffWatch watch({});
  fly(watch, {0, 10, 52.0});
  fly(watch, {10, 13.2, 52.0, 2});
  EXPECT_FALSE(watch.has_taken_off(at_s(13.2)));
  fly(watch, {13.2, 13.8, 58.4, 2});
  EXPECT_TRUE(watch.has_taken_off(at_s(13.8)));
  EXPECT_NEAR(*watch.ground_height_m(), 52.0, 0.1);
}

TEST(TakeOffWatch, IsNotFooledByOneWrongHeight) {
  TakeOffWatch watch({});
  fly(watch, {0, 10, 52.0});
  fly(watch, {10, 10.2, 60.0});
  fly(watch, {10.2, 14, 52.0});
  EXPECT_FALSE(watch.has_taken_off(at_s(14)));
}

// Sigma 2 m now and 2 m of the ground: three sigmas of the difference are 8.5 m.
TEST(TakeOffWatch, AsksForMoreOfAReceiverThatKnowsLess) {
  TakeOffWatch watch({});
  fly(watch, {0, 10, 52.0, 0, 2.0});
  fly(watch, {10, 13, 58.0, 0, 2.0});
  EXPECT_FALSE(watch.has_taken_off(at_s(13)));
  fly(watch, {13, 16, 62.0, 0, 2.0});
  EXPECT_TRUE(watch.has_taken_off(at_s(16)));
}

// A single position 5 m too low becomes a fixed one: the antenna has not moved.
TEST(TakeOffWatch, TakesNoBetterPositionForATakeOff) {
  TakeOffWatch watch({});
  fly(watch, {0, 15, 47.0, 0, 6.0});
  for (int second = 15; second < 40; ++second) {
    fly(watch, {1.0 * second, second + 1.0, 52.0});
    EXPECT_FALSE(watch.has_taken_off(at_s(second + 1))) << second;
  }
  EXPECT_NEAR(*watch.ground_height_m(), 52.0, 0.1);
}

TEST(TakeOffWatch, HasLandedAfterFiveSecondsLowAndStill) {
  TakeOffWatch watch({});
  fly(watch, {0, 10, 52.0});
  fly(watch, {10, 20, 52.0, 2});
  fly(watch, {20, 25, 72.0, -4});
  EXPECT_FALSE(watch.has_landed(at_s(25)));
  fly(watch, {25, 29.8, 52.0});
  EXPECT_FALSE(watch.has_landed(at_s(29.8)));
  fly(watch, {29.8, 30.4, 52.0});
  EXPECT_TRUE(watch.has_landed(at_s(30.4)));
}

TEST(TakeOffWatch, BelievesTheVehicleWhereItIsToldTo) {
  TakeOffOptions options;
  options.by = TakeOffBy::kArmed;
  TakeOffWatch watch(options);
  fly(watch, {0, 10, 52.0});
  fly(watch, {10, 20, 52.0, 2});
  watch.set_armed(false);
  EXPECT_FALSE(watch.has_taken_off(at_s(20)));
  watch.set_armed(true);
  EXPECT_TRUE(watch.has_taken_off(at_s(20)));
  EXPECT_FALSE(watch.has_landed(at_s(20)));
  watch.set_armed(false);
  EXPECT_TRUE(watch.has_landed(at_s(20)));
}

TEST(TakeOffWatch, KnowsTheGroundOfBeforeARestartInTheAir) {
  TakeOffWatch watch({});
  watch.resume(52.0);
  fly(watch, {0, 2.4, 70.0});
  EXPECT_TRUE(watch.has_taken_off(at_s(2.4)));
  EXPECT_DOUBLE_EQ(*watch.ground_height_m(), 52.0);
}

}  // namespace
}  // namespace plumbline::capture
