// SPDX-License-Identifier: MIT
#include "firmware/ingest/gimbal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "edge/geometry/rotation.h"

namespace plumbline::ingest {
namespace {

using Eigen::Vector3d;
constexpr double kRad = M_PI / 180;

GimbalAttitude gimbal(double yaw_deg, double pitch_deg, double roll_deg) {
  return {yaw_deg, pitch_deg, roll_deg};
}

TEST(Gimbal, StraightDownPointsTheTopOfThePhotoAlongTheYaw) {
  EXPECT_TRUE(ground_from_photo_of(gimbal(0, -90, 0)).isIdentity(1e-12));
  // Yaw 90: the top of the photo to the east, its right side to the south.
  const Eigen::Matrix3d east = ground_from_photo_of(gimbal(90, -90, 0));
  EXPECT_NEAR((east.col(1) - Vector3d::UnitX()).norm(), 0, 1e-12);
  EXPECT_NEAR((east.col(0) + Vector3d::UnitY()).norm(), 0, 1e-12);
  const GimbalPriors priors = gimbal_priors(gimbal(90, -90, 0));
  ASSERT_TRUE(priors.heading && priors.attitude);
  EXPECT_NEAR(priors.heading->heading_rad, 90 * kRad, 1e-12);
  EXPECT_NEAR(priors.heading->sigma_rad, 5 * kRad, 1e-12);
  // At zero tilt heading = -kappa.
  EXPECT_NEAR(priors.attitude->omega_phi_kappa_rad[2], -90 * kRad, 1e-12);
  EXPECT_TRUE(std::isinf(priors.attitude->sigma_rad[2]));
}

// A camera level and looking north: right is east, up is up, the view is along -z.
TEST(Gimbal, LevelLooksAlongTheYaw) {
  const Eigen::Matrix3d north = ground_from_photo_of(gimbal(0, 0, 0));
  EXPECT_NEAR((north.col(0) - Vector3d::UnitX()).norm(), 0, 1e-12);
  EXPECT_NEAR((north.col(1) - Vector3d::UnitZ()).norm(), 0, 1e-12);
  EXPECT_NEAR((north.col(2) + Vector3d::UnitY()).norm(), 0, 1e-12);
  // Rolled by 10 degrees the right side is low.
  EXPECT_NEAR(ground_from_photo_of(gimbal(0, 0, 10)).col(0).z(), -std::sin(10 * kRad), 1e-12);
}

TEST(Gimbal, ATiltForwardsTurnsAboutTheRightAxis) {
  // Yaw 0, pitch -80: the view goes 10 degrees north of straight down, a rotation by +10 degrees
  // about east (omega).
  const GimbalPriors priors = gimbal_priors(gimbal(0, -80, 0));
  EXPECT_NEAR(priors.attitude->omega_phi_kappa_rad[0], 10 * kRad, 1e-12);
  EXPECT_NEAR(priors.attitude->omega_phi_kappa_rad[1], 0, 1e-12);
  const Vector3d view = ground_from_photo_of(gimbal(0, -80, 0)) * -Vector3d::UnitZ();
  EXPECT_NEAR(view.y(), std::sin(10 * kRad), 1e-12);
}

TEST(Gimbal, IsARotationAtAnyAttitude) {
  for (double yaw = -170; yaw < 180; yaw += 35) {
    for (double pitch = -120; pitch <= 30; pitch += 25) {
      for (double roll = -180; roll <= 180; roll += 45) {
        const Eigen::Matrix3d r = ground_from_photo_of(gimbal(yaw, pitch, roll));
        EXPECT_TRUE((r * r.transpose()).isIdentity(1e-12));
        EXPECT_NEAR(r.determinant(), 1, 1e-12);
      }
    }
  }
}

TEST(Gimbal, SaysNothingOfAnObliqueCameraOrOfATiltWithoutDirection) {
  const GimbalPriors oblique = gimbal_priors(gimbal(0, -20, 0));
  EXPECT_FALSE(oblique.attitude || oblique.heading);
  GimbalAttitude without_yaw = gimbal(0, -80, 0);
  without_yaw.yaw_deg.reset();
  EXPECT_FALSE(gimbal_priors(without_yaw).attitude);
  without_yaw.pitch_deg = -89.5;
  EXPECT_TRUE(gimbal_priors(without_yaw).attitude);
  EXPECT_FALSE(gimbal_priors(without_yaw).heading);
}

}  // namespace
}  // namespace plumbline::ingest
