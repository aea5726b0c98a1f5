// SPDX-License-Identifier: MIT
#include "sim/flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_flight.h"

namespace plumbline::sim {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(Flight, ClimbsByTheNamedProfiles) {
  EXPECT_THAT(climb_heights_m(*named_profile("paper")), ElementsAre(70, 75, 80, 85, 90));
  EXPECT_TRUE(named_profile("paper")->side_steps_m.empty());
  const auto standard = climb_heights_m(*named_profile("standard"));
  EXPECT_EQ(standard.size(), 13u);
  EXPECT_THAT(named_profile("standard")->side_steps_m, ElementsAre(10));
  const auto ice = climb_heights_m(*named_profile("ice"));
  EXPECT_EQ(ice.size(), 21u);
  EXPECT_EQ(ice[1], 12.5);
  EXPECT_THAT(named_profile("ice")->side_steps_m, ElementsAre(5));
}

TEST(Flight, EndsAtTheTopWhereTheStepDoesNotDivideTheClimb) {
  Profile profile = small_profile();
  profile.to_m = 17;
  EXPECT_THAT(climb_heights_m(profile), ElementsAre(12, 14, 16, 17));
}

TEST(Flight, StepsAsideAtTheTopAndTurnsForTheSecondLeg) {
  Profile profile = small_profile();
  profile.side_steps_m = {10, 4};
  profile.side_direction_deg = 90;
  profile.drift_m = profile.wander_m = profile.height_sigma_m = 0;
  const Flight flight = fly(profile, 1);
  ASSERT_EQ(flight.shots.size(), 5u);
  EXPECT_NEAR((flight.shots[3].pose.centre_m - Eigen::Vector3d(10, 0, 16)).norm(), 0, 1e-9);
  EXPECT_NEAR((flight.shots[4].pose.centre_m - Eigen::Vector3d(10, -4, 16)).norm(), 0, 1e-9);
}

TEST(Flight, TakesItsTimeForTheWayAndThePauses) {
  Profile profile = small_profile();
  profile.drift_m = profile.wander_m = profile.height_sigma_m = 0;
  const Flight flight = fly(profile, 1);
  EXPECT_NEAR(flight.shots[1].time_s, 2 / 2.0 + 2, 1e-9);  // 2 m at 2 m/s, 2 s of pause
}

TEST(Flight, PointsTheTopOfThePhotoToTheYawWanted) {
  Profile profile = small_profile();
  profile.yaw_deg = 90;
  profile.tilt_sigma_deg = 0;
  profile.heading_sigma_deg = 0;
  const Flight flight = fly(profile, 1);
  const Eigen::Vector3d top = flight.shots[0].pose.ground_from_photo * Eigen::Vector3d::UnitY();
  EXPECT_NEAR((top - Eigen::Vector3d::UnitX()).norm(), 0, 1e-12);  // east
  EXPECT_NEAR(flight.shots[0].compass_deg, 90, 1e-9);
}

TEST(Flight, ScattersAsItsSigmasSay) {
  Profile profile = small_profile();
  profile.tilt_sigma_deg = 1;
  profile.side_steps_m.clear();
  double tilt2 = 0, focal2 = 0, gnss2 = 0, compass2 = 0;
  constexpr int kFlights = 3000;
  for (int seed = 1; seed <= kFlights; ++seed) {
    const Flight flight = fly(profile, static_cast<std::uint64_t>(seed));
    const Shot& shot = flight.shots[1];
    const Eigen::Vector3d up = shot.pose.ground_from_photo.col(2);
    tilt2 += std::pow(std::atan2(std::hypot(up.x(), up.y()), up.z()) * 180 / std::numbers::pi, 2);
    focal2 += std::pow(flight.calibrated_camera.interior[0] - flight.camera.interior[0], 2);
    gnss2 += std::pow(shot.gnss_in_enu_m.z() - shot.pose.centre_m.z(), 2);
    const Eigen::Vector3d top = shot.pose.ground_from_photo.col(1);
    const double truth_deg = std::atan2(top.x(), top.y()) * 180 / std::numbers::pi;
    compass2 += std::pow(std::remainder(shot.compass_deg - truth_deg, 360), 2);
  }
  // 3000 draws: the mean square scatters by 2.6 %.
  EXPECT_NEAR(tilt2 / kFlights, 2.0, 0.2);  // omega and phi, 1 degree each
  EXPECT_NEAR(focal2 / kFlights, 0.25, 0.03);
  EXPECT_NEAR(gnss2 / kFlights, 1e-4, 1.3e-5);
  EXPECT_NEAR(compass2 / kFlights, 4.0, 0.5);
}

TEST(Flight, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Flight a = fly(small_profile(), 5);
  const Flight b = fly(small_profile(), 5);
  const Flight c = fly(small_profile(), 6);
  for (std::size_t k = 0; k < a.shots.size(); ++k) {
    EXPECT_EQ(a.shots[k].pose.centre_m, b.shots[k].pose.centre_m);
    EXPECT_EQ(a.shots[k].pose.ground_from_photo, b.shots[k].pose.ground_from_photo);
    EXPECT_EQ(a.shots[k].gnss_in_enu_m, b.shots[k].gnss_in_enu_m);
    EXPECT_NE(a.shots[k].gnss_in_enu_m, c.shots[k].gnss_in_enu_m);
  }
}

TEST(Flight, LaysThePapersTargetsAllInViewOfEveryPhoto) {
  const Profile profile = *named_profile("paper");
  WorldOptions options = world_for(profile, 2, 2);
  TargetOptions targets = options.targets;
  Terrain terrain({options.half_extent_m, 0.4, 1, 1, 2, 2});
  const auto laid = lay_targets(targets, terrain);
  EXPECT_EQ(laid.size(), 39u);
  for (const Target& target : laid) {
    EXPECT_LT(target.centre_m.head<2>().norm(), 35);
    EXPECT_GT(2 * target.disc_radius_m * profile.focal_length_px / 90, 6);  // pixels from the top
  }
}

}  // namespace
}  // namespace plumbline::sim
