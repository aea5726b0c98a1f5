// SPDX-License-Identifier: MIT
#include "firmware/ingest/stations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::ingest {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Photos of a climb above one place, 5 m and 2 s apart.
std::vector<PhotoRecord> climb(PhotoFix fix, std::optional<Eigen::Vector3d> sigma,
                               HeightKind kind) {
  std::vector<PhotoRecord> photos(5);
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const auto step = static_cast<double>(i);
    photos[i].name = std::to_string(i) + ".jpg";
    photos[i].position = PhotoPosition{35.36, 139.13, 190 + 5 * step, kind, fix, sigma, {}};
    photos[i].position->height_above_start_m = 70 + 5 * step;
    photos[i].time.camera_clock =
        UtcTime(std::chrono::sys_days(std::chrono::year(2026) / 11 / 20)) +
        2s * static_cast<int>(i);
  }
  return photos;
}

double white(const Stations& stations, int axis) {
  return std::sqrt(stations.photos[0].station->covariance_m2(axis, axis));
}

TEST(Stations, OfARtkFlightHaveTheSigmasThatTheyState) {
  const auto stations = stations_of(
      climb(PhotoFix::kFixed, Eigen::Vector3d(0.005, 0.006, 0.010), HeightKind::kEllipsoidal), {});
  ASSERT_TRUE(stations.ok());
  EXPECT_THAT(stations->warnings, IsEmpty());
  EXPECT_TRUE(stations->absolute_height_known);
  EXPECT_NEAR(white(*stations, 0), 0.005, 1e-9);
  EXPECT_NEAR(white(*stations, 1), 0.006, 1e-9);
  EXPECT_NEAR(white(*stations, 2), 0.010, 1e-9);
  EXPECT_EQ(stations->gnss.offset_sigma_vertical_m, 0);
  EXPECT_EQ(stations->gnss.correlation_s, 0);
  // The frame lies on the ground at the start, below the first photo.
  ASSERT_TRUE(stations->frame);
  EXPECT_EQ(stations->frame->origin().height_ellipsoidal_m, 120);
  EXPECT_NEAR(stations->photos[2].station->antenna_in_enu_m.z(), 80, 1e-6);
  EXPECT_NEAR(stations->photos[2].station->antenna_in_enu_m.head<2>().norm(), 0, 1e-6);
  EXPECT_EQ(stations->photos[2].time_s, 4);
}

TEST(Stations, WithFixedPositionsThatStateNoSigmaGetTheUsualOneAndSaySo) {
  const auto stations =
      stations_of(climb(PhotoFix::kFixed, std::nullopt, HeightKind::kEllipsoidal), {});
  EXPECT_NEAR(white(*stations, 0), 0.02, 1e-9);
  EXPECT_NEAR(white(*stations, 2), 0.03, 1e-9);
  EXPECT_THAT(stations->warnings, Contains(HasSubstr("state no sigma")));
}

TEST(Stations, OfSingleFixesShareAnOffsetAndADrift) {
  const auto stations =
      stations_of(climb(PhotoFix::kSingle, std::nullopt, HeightKind::kEllipsoidal), {});
  EXPECT_NEAR(stations->gnss.offset_sigma_horizontal_m, 3, 1e-9);
  EXPECT_NEAR(stations->gnss.offset_sigma_vertical_m, 6, 1e-9);
  EXPECT_NEAR(stations->gnss.correlated_sigma_vertical_m, 3, 1e-9);
  EXPECT_GT(stations->gnss.correlation_s, 0);
  EXPECT_NEAR(white(*stations, 0), 1, 1e-6);
  EXPECT_THAT(stations->warnings, Contains(HasSubstr("single fixes")));
}

TEST(Stations, WithoutTimesCountDriftAsNoise) {
  auto photos = climb(PhotoFix::kSingle, std::nullopt, HeightKind::kEllipsoidal);
  photos[3].time.camera_clock.reset();
  const auto stations = stations_of(photos, {});
  EXPECT_EQ(stations->gnss.correlation_s, 0);
  EXPECT_EQ(stations->gnss.correlated_sigma_vertical_m, 0);
  EXPECT_NEAR(white(*stations, 0), std::hypot(1, 1.5), 1e-6);
  EXPECT_FALSE(stations->photos[0].time_s);
}

TEST(Stations, OfAMixedFlightWeighTheBadOnesLess) {
  auto photos =
      climb(PhotoFix::kFixed, Eigen::Vector3d(0.01, 0.01, 0.02), HeightKind::kEllipsoidal);
  photos[1].position->fix = PhotoFix::kFloat;
  photos[1].position->sigma_enu_m.reset();
  const auto stations = stations_of(photos, {});
  EXPECT_EQ(stations->gnss.offset_sigma_horizontal_m, 0);
  EXPECT_NEAR(white(*stations, 0), 0.01, 1e-9);
  EXPECT_GT(std::sqrt(stations->photos[1].station->covariance_m2(0, 0)), 0.3);
  EXPECT_THAT(stations->warnings, Contains(HasSubstr("1 of 5 positions are not fixed")));
}

TEST(Stations, WhoseHeightSystemNobodySaysShareFiftyMetres) {
  const auto photos = climb(PhotoFix::kNotSaid, std::nullopt, HeightKind::kUnknown);
  const auto assumed = stations_of(photos, {});
  EXPECT_NEAR(assumed->gnss.offset_sigma_vertical_m, std::hypot(50, 8), 1e-9);
  EXPECT_FALSE(assumed->absolute_height_known);
  EXPECT_THAT(assumed->warnings, Contains(HasSubstr("--photo-heights")));
  StationOptions said;
  said.photo_heights = "ellipsoidal";
  const auto stated = stations_of(photos, said);
  EXPECT_NEAR(stated->gnss.offset_sigma_vertical_m, 8, 1e-9);
  EXPECT_TRUE(stated->absolute_height_known);
}

TEST(Stations, AboveAGeoidNeedIt) {
  const auto photos = climb(PhotoFix::kNotSaid, std::nullopt, HeightKind::kUnknown);
  StationOptions options;
  options.photo_heights = "egm96";
  const auto without = stations_of(photos, options);
  ASSERT_FALSE(without.ok());
  EXPECT_THAT(without.error().sentence, HasSubstr("--geoid"));
  std::string isg =
      "begin_of_head =\nlat min = 35\nlat max = 36\nlon min = 139\nlon max = 140\n"
      "delta lat = 1\ndelta lon = 1\nnrows = 2\nncols = 2\nend_of_head =\n40 40 40 40\n";
  const auto geoid =
      geodesy::Geoid::parse({reinterpret_cast<const std::uint8_t*>(isg.data()), isg.size()}, "g");
  options.geoid = &*geoid;
  const auto with = stations_of(photos, options);
  ASSERT_TRUE(with.ok()) << with.error().sentence;
  EXPECT_EQ(with->frame->origin().height_ellipsoidal_m, 160);
  EXPECT_TRUE(with->absolute_height_known);
}

TEST(Stations, WithoutAnyPositionAreAFreeNetworkAndSaySo) {
  auto photos = climb(PhotoFix::kNotSaid, std::nullopt, HeightKind::kUnknown);
  for (PhotoRecord& photo : photos) photo.position.reset();
  const auto stations = stations_of(photos, {});
  ASSERT_TRUE(stations.ok());
  EXPECT_FALSE(stations->frame);
  EXPECT_EQ(stations->photos.size(), 5u);
  EXPECT_FALSE(stations->photos[0].station);
  EXPECT_THAT(stations->warnings, Contains(HasSubstr("no positions")));
}

TEST(Stations, PassOnWhatTheGimbalSays) {
  auto photos = climb(PhotoFix::kFixed, std::nullopt, HeightKind::kEllipsoidal);
  photos[0].gimbal = GimbalAttitude{30, -90, 0};
  const auto stations = stations_of(photos, {});
  ASSERT_TRUE(stations->photos[0].heading);
  EXPECT_NEAR(stations->photos[0].heading->heading_rad, 30 * M_PI / 180, 1e-12);
  EXPECT_FALSE(stations->photos[1].attitude);
}

}  // namespace
}  // namespace plumbline::ingest
