// SPDX-License-Identifier: MIT
#include "drivers/jump_check.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

using std::chrono::milliseconds;

constexpr double kDegreesPerMetre = 1.0 / 110'950;  // of latitude, at 35.67 degrees

GnssFix fix_at(double north_m, double up_m, int time_ms, FixQuality quality = FixQuality::kFixed) {
  GnssFix fix;
  fix.time = UtcTime(milliseconds(time_ms));
  fix.quality = quality;
  fix.latitude_deg = 35.67 + north_m * kDegreesPerMetre;
  fix.longitude_deg = 139.76;
  fix.height_ellipsoidal_m = 90 + up_m;
  return fix;
}

std::optional<Jump> between(const GnssFix& a, const GnssFix& b) {
  JumpCheck check;
  check.take(a, HostTime{});
  return check.take(b, HostTime(milliseconds(200)));
}

TEST(JumpCheck, FindsHundredMetresBetweenEpochsOfEveryQuality) {
  for (const FixQuality quality :
       {FixQuality::kSingle, FixQuality::kDifferential, FixQuality::kFloat, FixQuality::kFixed}) {
    const auto jump = between(fix_at(0, 0, 0, quality), fix_at(100, 0, 200, quality));
    ASSERT_TRUE(jump);
    EXPECT_NEAR(jump->distance_m, 100, 0.1);
    EXPECT_NEAR(jump->seconds, 0.2, 1e-9);
  }
}

TEST(JumpCheck, FindsAJumpOfHeightAlone) {
  EXPECT_TRUE(between(fix_at(0, 0, 0), fix_at(0, 12, 200)));
}

TEST(JumpCheck, LetsTheDroneFly) {
  EXPECT_FALSE(between(fix_at(0, 0, 0), fix_at(3, 1, 200)));
  EXPECT_FALSE(between(fix_at(0, 0, 0), fix_at(250, 0, 10'000)));  // after a gap
}

TEST(JumpCheck, LetsASolutionBecomeFixed) {
  EXPECT_FALSE(between(fix_at(0, 0, 0, FixQuality::kSingle), fix_at(12, 15, 200)));
}

TEST(JumpCheck, AllowsWhatTheReceiverSaysThatItDoesNotKnow) {
  GnssFix vague = fix_at(60, 0, 200);
  vague.covariance_enu_m2 = Eigen::Matrix3d(Eigen::Vector3d(100, 100, 100).asDiagonal());
  EXPECT_FALSE(between(fix_at(0, 0, 0), vague));
}

TEST(JumpCheck, TakesOnlyMeasuredPositionsForSuch) {
  EXPECT_TRUE(is_measured_position(fix_at(0, 0, 0)));
  EXPECT_FALSE(is_measured_position(fix_at(0, 0, 0, FixQuality::kEstimated)));
  EXPECT_FALSE(is_measured_position(fix_at(0, 0, 0, FixQuality::kNone)));
  EXPECT_FALSE(is_measured_position(GnssFix{}));
}

}  // namespace
}  // namespace plumbline
