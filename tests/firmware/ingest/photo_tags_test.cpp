// SPDX-License-Identifier: MIT
#include "firmware/ingest/photo_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "tests/firmware/ingest/tagged_photo.h"

namespace plumbline::ingest {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Reading {
  PhotoRecord record;
  std::vector<std::string> warnings;
};

Reading read(const PhotoContent& content) {
  Reading reading;
  reading.record.name = "a.jpg";
  reading.record.width_px = content.width_px;
  reading.record.height_px = content.height_px;
  const auto bytes = tagged_photo(content);
  interpret(read_tags(bytes, "a.jpg", reading.warnings), reading.record, reading.warnings);
  return reading;
}

PhotoContent rtk_photo() {
  PhotoContent content;
  content.exif = exif_position();
  content.xmp = {{"Xmp.drone-dji.RtkFlag", "50"},
                 {"Xmp.drone-dji.GpsLatitude", "+35.361251234"},
                 {"Xmp.drone-dji.GpsLongitude", "+139.131181234"},
                 {"Xmp.drone-dji.AbsoluteAltitude", "+123.456"},
                 {"Xmp.drone-dji.RelativeAltitude", "+70.10"},
                 {"Xmp.drone-dji.RtkStdLon", "0.011"},
                 {"Xmp.drone-dji.RtkStdLat", "0.012"},
                 {"Xmp.drone-dji.RtkStdHgt", "0.023"},
                 {"Xmp.drone-dji.GimbalYawDegree", "-30.5"},
                 {"Xmp.drone-dji.GimbalPitchDegree", "-89.90"},
                 {"Xmp.drone-dji.GimbalRollDegree", "+0.20"},
                 {"Xmp.drone-dji.FlightXSpeed", "1.5"},
                 {"Xmp.drone-dji.FlightYSpeed", "-0.5"},
                 {"Xmp.drone-dji.FlightZSpeed", "-2.0"}};
  return content;
}

TEST(PhotoTags, OfAPlainCameraGiveAPositionOfUnknownHeightSystem) {
  PhotoContent content;
  content.exif = exif_position();
  content.exif["Exif.GPSInfo.GPSMapDatum"] = "WGS-84";
  const Reading reading = read(content);
  ASSERT_TRUE(reading.record.position);
  const PhotoPosition& position = *reading.record.position;
  EXPECT_NEAR(position.latitude_deg, 35 + 21 / 60. + 40.5 / 3600, 1e-12);
  EXPECT_NEAR(position.longitude_deg, 139 + 7 / 60. + 52.25 / 3600, 1e-12);
  EXPECT_NEAR(*position.height_m, 123.45, 1e-9);
  EXPECT_EQ(position.height_kind, HeightKind::kUnknown);
  EXPECT_EQ(position.fix, PhotoFix::kNotSaid);
  EXPECT_FALSE(position.sigma_enu_m);
  EXPECT_THAT(reading.warnings, IsEmpty());
}

TEST(PhotoTags, KnowSouthWestAndBelow) {
  PhotoContent content;
  content.exif = exif_position();
  content.exif["Exif.GPSInfo.GPSLatitudeRef"] = "S";
  content.exif["Exif.GPSInfo.GPSLongitudeRef"] = "W";
  content.exif["Exif.GPSInfo.GPSAltitudeRef"] = "1";
  const auto position = read(content).record.position;
  EXPECT_LT(position->latitude_deg, -35);
  EXPECT_LT(position->longitude_deg, -139);
  EXPECT_NEAR(*position->height_m, -123.45, 1e-9);
}

TEST(PhotoTags, OfAnRtkDroneGiveItsDigitsAndSigmas) {
  const Reading reading = read(rtk_photo());
  ASSERT_TRUE(reading.record.position);
  const PhotoPosition& position = *reading.record.position;
  EXPECT_DOUBLE_EQ(position.latitude_deg, 35.361251234);
  EXPECT_DOUBLE_EQ(position.longitude_deg, 139.131181234);
  EXPECT_DOUBLE_EQ(*position.height_m, 123.456);
  EXPECT_EQ(position.height_kind, HeightKind::kEllipsoidal);
  EXPECT_EQ(position.fix, PhotoFix::kFixed);
  EXPECT_EQ(*position.sigma_enu_m, Eigen::Vector3d(0.011, 0.012, 0.023));
  EXPECT_EQ(position.height_above_start_m, 70.10);
  ASSERT_TRUE(reading.record.gimbal);
  EXPECT_EQ(reading.record.gimbal->yaw_deg, -30.5);
  EXPECT_EQ(reading.record.gimbal->pitch_deg, -89.9);
  EXPECT_EQ(*reading.record.velocity_in_enu_m_s, Eigen::Vector3d(-0.5, 1.5, 2.0));
}

TEST(PhotoTags, TellTheKindsOfFixApart) {
  for (const auto& [flag, fix] : {std::pair{"0", PhotoFix::kNone},
                                  {"16", PhotoFix::kSingle},
                                  {"34", PhotoFix::kFloat},
                                  {"50", PhotoFix::kFixed}}) {
    PhotoContent content = rtk_photo();
    content.xmp["Xmp.drone-dji.RtkFlag"] = flag;
    EXPECT_EQ(read(content).record.position->fix, fix) << flag;
  }
}

TEST(PhotoTags, TakeEllipsoidalHeightsByTheMapDatumAndAccuraciesOfAnyWriter) {
  PhotoContent content;
  content.exif = exif_position();
  content.exif["Exif.GPSInfo.GPSMapDatum"] = "WGS-84 (ellipsoidal height)";
  content.xmp = {{"Xmp.Camera.GPSXYAccuracy", "0.02"}, {"Xmp.Camera.GPSZAccuracy", "0.05"}};
  const auto position = read(content).record.position;
  EXPECT_EQ(position->height_kind, HeightKind::kEllipsoidal);
  EXPECT_EQ(*position->sigma_enu_m, Eigen::Vector3d(0.02, 0.02, 0.05));
}

TEST(PhotoTags, WithImpossiblePositionsAreWarnedOf) {
  for (const auto& [latitude, longitude] : {std::pair{"0/1 0/1 0/1", "0/1 0/1 0/1"},
                                            {"91/1 0/1 0/1", "10/1 0/1 0/1"},
                                            {"35/1 0/1 0/1", "181/1 0/1 0/1"}}) {
    PhotoContent content;
    content.exif = exif_position();
    content.exif["Exif.GPSInfo.GPSLatitude"] = latitude;
    content.exif["Exif.GPSInfo.GPSLongitude"] = longitude;
    const Reading reading = read(content);
    EXPECT_FALSE(reading.record.position);
    EXPECT_THAT(reading.warnings, ElementsAre(HasSubstr("'a.jpg' was not used")));
  }
  PhotoContent content;
  content.exif = exif_position();
  content.exif["Exif.GPSInfo.GPSLatitude"] = "35/0 0/0 0/0";
  EXPECT_FALSE(read(content).record.position);
  content.exif = exif_position();
  content.exif["Exif.GPSInfo.GPSAltitude"] = "99999999/1";
  const Reading high = read(content);
  ASSERT_TRUE(high.record.position);
  EXPECT_FALSE(high.record.position->height_m);
  EXPECT_EQ(high.warnings.size(), 1u);
}

TEST(PhotoTags, GiveTheTimeToItsFractionAndItsZone) {
  PhotoContent content;
  content.exif = {{"Exif.Photo.DateTimeOriginal", "2026:11:20 19:00:01"},
                  {"Exif.Photo.SubSecTimeOriginal", "054"},
                  {"Exif.Photo.OffsetTimeOriginal", "+09:00"}};
  const PhotoTime time = read(content).record.time;
  const UtcTime expected = std::chrono::sys_days(2026y / 11 / 20) + 10h + 1s + 54ms;
  EXPECT_EQ(utc_of(time), expected);
  EXPECT_TRUE(time.has_subseconds);
  content.exif.erase("Exif.Photo.OffsetTimeOriginal");
  EXPECT_EQ(utc_of(read(content).record.time), std::nullopt);
  // The receiver's clock tells the zone: 19:00:01.054 is 9 h ahead of 10:00:00.
  content.exif["Exif.GPSInfo.GPSDateStamp"] = "2026:11:20";
  content.exif["Exif.GPSInfo.GPSTimeStamp"] = "10/1 0/1 0/1";
  EXPECT_EQ(utc_of(read(content).record.time), expected);
  // A camera clock that is 3 minutes off tells nothing: the receiver's time is taken.
  content.exif["Exif.GPSInfo.GPSTimeStamp"] = "9/1 57/1 0/1";
  EXPECT_EQ(utc_of(read(content).record.time),
            UtcTime(std::chrono::sys_days(2026y / 11 / 20) + 9h + 57min));
  content.exif["Exif.Photo.DateTimeOriginal"] = "0000:00:00 00:00:00";
  EXPECT_FALSE(read(content).record.time.camera_clock);
}

TEST(PhotoTags, GiveTheFocalPlaneInPixelsPerMillimetre) {
  PhotoContent content;
  content.exif = {{"Exif.Photo.FocalPlaneXResolution", "16393442/1000"},
                  {"Exif.Photo.FocalPlaneResolutionUnit", "2"},
                  {"Exif.Photo.PixelXDimension", "4000"}};
  content.width_px = 2000;  // made half as large since
  EXPECT_NEAR(*read(content).record.focal_plane_px_per_mm, 16393.442 / 25.4 / 2, 1e-6);
  content.exif["Exif.Photo.FocalPlaneResolutionUnit"] = "3";
  EXPECT_NEAR(*read(content).record.focal_plane_px_per_mm, 1639.3442 / 2, 1e-6);
}

TEST(PhotoTags, ThatAreDamagedNeverCrash) {
  const auto whole = tagged_photo(rtk_photo());
  std::mt19937 random(17);
  for (int trial = 0; trial < 1500; ++trial) {
    auto bytes = whole;
    for (auto flips = 1 + random() % 6; flips > 0; --flips) {
      bytes[random() % std::min<std::size_t>(bytes.size(), 3000)] =
          static_cast<std::uint8_t>(random());
    }
    PhotoRecord record;
    record.width_px = 64;
    record.height_px = 48;
    std::vector<std::string> warnings;
    interpret(read_tags(bytes, "a.jpg", warnings), record, warnings);
    if (record.position) {
      EXPECT_LE(std::abs(record.position->latitude_deg), 90);
    }
  }
}

}  // namespace
}  // namespace plumbline::ingest
