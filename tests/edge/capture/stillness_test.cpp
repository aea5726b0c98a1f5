// SPDX-License-Identifier: MIT
#include "edge/capture/stillness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::capture {
namespace {

HostTime at_s(double seconds) {
  return HostTime(std::chrono::nanoseconds(std::llround(1e9 * seconds)));
}

// Five a second, of one velocity.
void fly(StillnessWatch& watch, double from_s, double until_s, const Eigen::Vector3d& m_s) {
  const int fixes = static_cast<int>(std::lround(5 * (until_s - from_s)));
  for (int k = 0; k < fixes; ++k) {
    Motion motion;
    motion.time = at_s(from_s + 0.2 * k);
    motion.velocity_m_s = m_s;
    watch.add(motion);
  }
}

TEST(StillnessWatch, FindsNoPauseInAClimb) {
  StillnessWatch watch({});
  fly(watch, 0, 20, {0, 0, 1});
  EXPECT_FALSE(watch.is_time(at_s(20)));
  EXPECT_FALSE(watch.is_still(at_s(20)));
}

// At rest from second 10 on: still after 0.5 s, a pause after 1 s.
TEST(StillnessWatch, WaitsForTheSecondThatMakesAPause) {
  StillnessWatch watch({});
  fly(watch, 0, 10, {0, 0, 2});
  fly(watch, 10, 12, {0, 0, 0});
  EXPECT_TRUE(watch.is_still(at_s(10.6)));
  EXPECT_FALSE(watch.is_time(at_s(10.9)));
  EXPECT_TRUE(watch.is_time(at_s(11)));
}

// No climb, but 0.4 m/s sideways: it waits for 1 s and 3 s, and no longer.
TEST(StillnessWatch, WaitsForRestNoLongerThanItsLimit) {
  StillnessWatch watch({});
  fly(watch, 0, 10, {0, 0, 2});
  fly(watch, 10, 15, {0.4, 0, 0.1});
  EXPECT_FALSE(watch.is_time(at_s(13.9)));
  EXPECT_TRUE(watch.is_time(at_s(14)));
  EXPECT_FALSE(watch.is_still(at_s(14)));
}

TEST(StillnessWatch, BeginsAnewAfterEachMotion) {
  StillnessWatch watch({});
  fly(watch, 0, 0.8, {0, 0, 0});
  fly(watch, 0.8, 1, {0, 0, 1});
  fly(watch, 1, 2, {0, 0, 0});
  EXPECT_FALSE(watch.is_time(at_s(1.9)));
  EXPECT_TRUE(watch.is_time(at_s(2)));
  watch.reset();
  EXPECT_FALSE(watch.is_time(at_s(3)));
}

}  // namespace
}  // namespace plumbline::capture
