// SPDX-License-Identifier: MIT
// Where the antenna is and will be: a climb of 2 m/s without noise, of which every height is known.
#include "edge/capture/navigator.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::capture {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kGround_m = 50;
constexpr milliseconds kLatency{80};  // what the navigator takes for the receiver's least
const UtcTime kStart =
    std::chrono::sys_days(std::chrono::year(2026) / 11 / 20) + std::chrono::hours(10);

HostTime at_s(double seconds) {
  return HostTime(std::chrono::nanoseconds(std::llround(1e9 * seconds)));
}

// The host's clock was 0 at kStart. Up from the start on.
double height_m(double seconds) { return kGround_m + 2 * seconds; }

GnssFix fix_at(double seconds, FixQuality quality = FixQuality::kFixed) {
  GnssFix fix;
  fix.time = kStart + std::chrono::microseconds(std::llround(1e6 * seconds));
  fix.quality = quality;
  fix.latitude_deg = 35.66;
  fix.longitude_deg = 139.76;
  fix.height_ellipsoidal_m = height_m(seconds);
  fix.covariance_enu_m2 = Eigen::Vector3d(0.01, 0.01, 0.02).cwiseAbs2().asDiagonal();
  return fix;
}

// Five a second, up to the time.
void climb(Navigator& navigator, double until_s, FixQuality quality = FixQuality::kFixed) {
  for (int k = 0; 0.2 * k <= until_s + 1e-6; ++k) {
    (void)navigator.add(fix_at(0.2 * k, quality), at_s(0.2 * k) + kLatency);
  }
}

TEST(Navigator, KnowsNothingBeforeTheFirstPositions) {
  Navigator navigator;
  EXPECT_FALSE(navigator.at(at_s(0)));
  GnssFix nothing;
  nothing.time = kStart;
  EXPECT_FALSE(navigator.add(nothing, at_s(0) + kLatency));
  EXPECT_FALSE(navigator.at(at_s(0.1)));
}

TEST(Navigator, ForeseesTheClimb) {
  Navigator navigator;
  climb(navigator, 10);
  for (const double ahead_s : {0.1, 0.5, 1.0}) {
    const auto motion = navigator.at(at_s(10 + ahead_s));
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->height_ellipsoidal_m, height_m(10 + ahead_s), 0.05) << ahead_s;
    EXPECT_NEAR(motion->climb_m_s(), 2, 0.05);
    EXPECT_FALSE(motion->reckoned);
    EXPECT_NEAR(std::chrono::duration<double>(motion->age).count(), ahead_s, 0.02);
    EXPECT_EQ(motion->quality, FixQuality::kFixed);
  }
}

TEST(Navigator, KnowsWhereItWasBetweenTwoFixes) {
  Navigator navigator;
  climb(navigator, 10);
  const auto motion = navigator.at(at_s(8.1));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->height_ellipsoidal_m, height_m(8.1), 0.02);
  EXPECT_FALSE(motion->reckoned);
}

// Fixes end at second 10. Of late until 11.2, reckoned by 2 m/s until 15, then nothing.
TEST(Navigator, ReckonsByTheLastVelocityForFiveSeconds) {
  Navigator navigator;
  climb(navigator, 10);
  EXPECT_FALSE(navigator.at(at_s(11.1))->reckoned);
  for (const double time_s : {11.4, 13.0, 14.9}) {
    const auto motion = navigator.at(at_s(time_s));
    ASSERT_TRUE(motion) << time_s;
    EXPECT_TRUE(motion->reckoned);
    EXPECT_NEAR(motion->height_ellipsoidal_m, height_m(time_s), 0.3) << time_s;
  }
  EXPECT_FALSE(navigator.at(at_s(15.1)));
}

// A metre per second more with each second is what it does not know: variance t^3/3. After 3 s, 9
// square metres.
TEST(Navigator, TrustsItsReckoningLessAndLess) {
  Navigator navigator;
  climb(navigator, 10);
  const auto motion = navigator.at(at_s(13));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->sigma_height_m(), 3, 0.2);
}

TEST(Navigator, IsBackWithTheNextFixes) {
  Navigator navigator;
  climb(navigator, 10);
  for (int k = 0; k < 10; ++k) {
    (void)navigator.add(fix_at(20 + 0.2 * k), at_s(20 + 0.2 * k) + kLatency);
  }
  const auto motion = navigator.at(at_s(21.9));
  ASSERT_TRUE(motion);
  EXPECT_FALSE(motion->reckoned);
  EXPECT_NEAR(motion->height_ellipsoidal_m, height_m(21.9), 0.2);
}

// Three metres up from second 10 to second 12, by fixes that know of nothing: one alone would be
// left out, three are believed, and doubted until they are taken back.
TEST(Navigator, DoubtsAPositionThatJumpedUntilItIsBack) {
  Navigator navigator;
  climb(navigator, 10);
  EXPECT_FALSE(navigator.has_jumped());
  for (int k = 1; k <= 20; ++k) {
    const double time_s = 10 + 0.2 * k;
    GnssFix fix = fix_at(time_s);
    if (k <= 10) *fix.height_ellipsoidal_m += 3;
    (void)navigator.add(fix, at_s(time_s) + kLatency);
    EXPECT_EQ(navigator.has_jumped(), k >= 3 && k <= 12) << k;
  }
}

TEST(Navigator, SaysOfWhatQualityItsPositionIs) {
  Navigator navigator;
  climb(navigator, 10, FixQuality::kFloat);
  EXPECT_EQ(navigator.at(at_s(10.1))->quality, FixQuality::kFloat);
}

// Three seconds before midnight on the wall, and the receiver is past it already: its day is the
// next one.
TEST(Navigator, GivesTimesOfDayTheDayNearestToTheWalls) {
  const UtcTime midnight = std::chrono::sys_days(std::chrono::year(2026) / 11 / 21);
  Navigator navigator;
  navigator.set_wall(WallTime(midnight.time_since_epoch() - seconds(3)), at_s(0));
  GnssFix fix = fix_at(0);
  fix.time.reset();
  for (int k = 0; k < 5; ++k) {
    fix.time_of_day = milliseconds(1000 + 200 * k);
    (void)navigator.add(fix, at_s(0.2 * k) + kLatency);
  }
  EXPECT_EQ(navigator.last_fix(), midnight + milliseconds(1800));
}

TEST(Navigator, TakesNoTimeOfDayWithoutAWall) {
  Navigator navigator;
  GnssFix fix = fix_at(0);
  fix.time.reset();
  fix.time_of_day = seconds(36000);
  EXPECT_FALSE(navigator.add(fix, at_s(0) + kLatency));
}

}  // namespace
}  // namespace plumbline::capture
