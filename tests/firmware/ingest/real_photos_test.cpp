// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "firmware/ingest/photo_folder.h"
#include "firmware/ingest/starting_camera.h"
#include "firmware/ingest/stations.h"

namespace plumbline::ingest {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

fs::path shared_data() {
  const char* const set = std::getenv("PLUMBLINE_SHARED");
  return (set ? fs::path(set) : fs::path(PLUMBLINE_SOURCE_DIR) / ".." / "shared") / "data";
}

// What `exiv2 -pt IMG_9354.jpg` prints: 30 10' 16.404" N, 98 5' 23.970" W, 317.3 m, 4.5 mm.
TEST(RealPhotos, OfACompactCameraAreTakenIn) {
  const fs::path folder = shared_data() / "climb";
  if (!fs::exists(folder)) GTEST_SKIP() << "no real photos in " << folder;
  const auto set = read_photos({folder}, 2, nullptr);
  ASSERT_TRUE(set.ok()) << set.error().sentence;
  ASSERT_EQ(set->photos.size(), 10u);
  const PhotoRecord& first = set->photos[0];
  EXPECT_EQ(first.name, "IMG_9354.jpg");
  EXPECT_NEAR(first.position->latitude_deg, 30 + 10 / 60. + 16.404 / 3600, 1e-10);
  EXPECT_NEAR(first.position->longitude_deg, -(98 + 5 / 60. + 23.970 / 3600), 1e-10);
  EXPECT_NEAR(*first.position->height_m, 317.3, 1e-9);
  EXPECT_EQ(first.focal_length_mm, 4.5);
  // 13:20:51 on the camera, 18:20:51 by GPS.
  EXPECT_EQ(*first.time.gps - *first.time.camera_clock, std::chrono::hours(5));

  const auto camera = starting_camera(set->photos);
  ASSERT_TRUE(camera.ok());
  EXPECT_NEAR(camera->camera.interior[geometry::kFocalLength], 2917, 1);

  const auto stations = stations_of(set->photos, {});
  ASSERT_TRUE(stations.ok());
  EXPECT_THAT(stations->warnings, Contains(HasSubstr("single fixes")));
  EXPECT_FALSE(stations->absolute_height_known);
  EXPECT_NEAR(stations->photos[9].station->antenna_in_enu_m.z() -
                  stations->photos[0].station->antenna_in_enu_m.z(),
              333.4 - 317.3, 0.01);
  EXPECT_EQ(stations->photos[9].time_s, 19);
}

// `exiv2 -pa DJI_0018.JPG`: gimbal yaw +45.00, pitch -89.90, absolute +198.31, relative +39.80.
TEST(RealPhotos, OfADroneAreTakenIn) {
  const fs::path folder = shared_data() / "nadir";
  if (!fs::exists(folder)) GTEST_SKIP() << "no real photos in " << folder;
  const auto set = read_photos({folder}, 2, nullptr);
  ASSERT_TRUE(set.ok()) << set.error().sentence;
  ASSERT_EQ(set->photos.size(), 5u);
  const PhotoRecord& first = set->photos[0];
  EXPECT_EQ(first.model, "FC300S");
  EXPECT_EQ(first.gimbal->yaw_deg, 45.0);
  EXPECT_EQ(first.gimbal->pitch_deg, -89.9);
  EXPECT_NEAR(*first.position->height_m, 198.309, 1e-9);
  EXPECT_EQ(first.position->height_above_start_m, 39.8);
  EXPECT_THAT(set->warnings, Contains(HasSubstr("'LICENSE'")));
  const auto stations = stations_of(set->photos, {});
  ASSERT_TRUE(stations.ok());
  EXPECT_TRUE(stations->photos[0].heading && stations->photos[0].attitude);
}

}  // namespace
}  // namespace plumbline::ingest
