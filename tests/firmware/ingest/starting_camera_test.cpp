// SPDX-License-Identifier: MIT
#include "firmware/ingest/starting_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumbline::ingest {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

PhotoRecord canon() {
  PhotoRecord photo;
  photo.name = "a.jpg";
  photo.make = "Canon";
  photo.model = "Canon PowerShot SX260 HS";
  photo.width_px = 4000;
  photo.height_px = 3000;
  photo.focal_length_mm = 4.5;
  photo.focal_plane_px_per_mm = 16393.442 / 25.4;
  return photo;
}

double focal(const StartingCamera& start) { return start.camera.interior[geometry::kFocalLength]; }
double relative_sigma(const StartingCamera& start) {
  return start.camera.sigma[geometry::kFocalLength] / focal(start);
}

TEST(StartingCamera, OfAKnownSensorIsGoodToThreePerCent) {
  const auto start = starting_camera({canon()});
  ASSERT_TRUE(start.ok());
  EXPECT_NEAR(focal(*start), 4.5 / 6.17 * 4000, 1e-6);  // 2917 px
  EXPECT_NEAR(relative_sigma(*start), 0.03, 1e-12);
  EXPECT_EQ(start->camera.interior[geometry::kPrincipalU], 1999.5);
  EXPECT_EQ(start->camera.interior[geometry::kPrincipalV], 1499.5);
  EXPECT_GT(start->camera.sigma[geometry::kRadial1], 0.01);
  EXPECT_EQ(start->camera.sigma[geometry::kRadial3], 0);
  EXPECT_TRUE(start->camera.sigma.allFinite());
  EXPECT_THAT(start->source, HasSubstr("2917 px"));
}

TEST(StartingCamera, FallsBackToTheFocalPlaneThenTheEquivalentThenAGuess) {
  PhotoRecord photo = canon();
  photo.model = "Unheard of";
  EXPECT_NEAR(focal(*starting_camera({photo})), 4.5 * 16393.442 / 25.4, 1e-6);
  photo.focal_plane_px_per_mm.reset();
  photo.focal_length_35mm = 25;
  const auto equivalent = starting_camera({photo});
  EXPECT_NEAR(focal(*equivalent), 25 / 43.267 * 5000, 1e-6);
  EXPECT_NEAR(relative_sigma(*equivalent), 0.05, 1e-12);
  photo.focal_length_35mm.reset();
  const auto guess = starting_camera({photo});
  EXPECT_NEAR(relative_sigma(*guess), 0.30, 1e-12);
  EXPECT_THAT(guess->source, HasSubstr("guess"));
}

// 20 mm on 4000 x 2250 cut from 4:3: the diagonal meant is that of 4000 x 3000.
TEST(StartingCamera, TakesAWidePhotoForACutOne) {
  PhotoRecord photo = canon();
  photo.model = "Unheard of";
  photo.focal_plane_px_per_mm.reset();
  photo.focal_length_35mm = 20;
  photo.height_px = 2250;
  EXPECT_NEAR(focal(*starting_camera({photo})), 20 / 43.267 * 5000, 0.03 * 2311);
}

TEST(StartingCamera, IsTheSameForAPhotoOnItsSide) {
  PhotoRecord photo = canon();
  std::swap(photo.width_px, photo.height_px);
  EXPECT_NEAR(focal(*starting_camera({photo})), 4.5 / 6.17 * 4000, 1e-6);
}

TEST(StartingCamera, KnowsRaspberryPiCamerasByTheirChip) {
  PhotoRecord photo = canon();
  photo.make = "Raspberry Pi";
  photo.model = "/base/soc/i2c0mux/i2c@1/imx477@1a";
  photo.width_px = 4056;
  photo.focal_length_mm = 6;
  EXPECT_NEAR(focal(*starting_camera({photo})), 6 / 1.55e-3, 0.005 * 3870);
}

TEST(StartingCamera, RefusesPhotosOfTwoCamerasAndWarnsOfZoom) {
  PhotoRecord other = canon();
  other.name = "b.jpg";
  other.model = "FC330";
  const auto two = starting_camera({canon(), other});
  ASSERT_FALSE(two.ok());
  EXPECT_THAT(two.error().sentence, HasSubstr("'b.jpg' is of another camera (FC330)"));
  PhotoRecord zoomed = canon();
  zoomed.focal_length_mm = 9;
  const auto zoom = starting_camera({canon(), zoomed});
  ASSERT_TRUE(zoom.ok());
  EXPECT_THAT(zoom->warnings, SizeIs(1));
}

}  // namespace
}  // namespace plumbline::ingest
