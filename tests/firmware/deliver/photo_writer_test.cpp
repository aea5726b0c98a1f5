// SPDX-License-Identifier: MIT
#include "firmware/deliver/photo_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "edge/jpeg/jpeg.h"

namespace plumbline::deliver {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::vector<std::uint8_t> small_jpeg() {
  Image image{32, 24, 3, std::vector<std::uint8_t>(32 * 24 * 3, 90)};
  for (std::size_t k = 0; k < image.data.size(); k += 7) image.data[k] = 200;
  return jpeg::encode(image, 93);
}

PhotoTags sample_tags() {
  using namespace std::chrono;
  PhotoTags tags;
  tags.make = "Plumbline";
  tags.model = "Simulated camera";
  tags.time =
      sys_days{year{2026} / April / 17} + hours{23} + minutes{59} + seconds{58} + milliseconds{47};
  tags.utc_offset = hours{9};
  tags.width_px = 4000;
  tags.height_px = 2250;
  tags.focal_length_mm = 3.995;
  tags.pixel_pitch_um = 1.88;
  tags.position = PhotoPosition{35.3612345678, -139.1301234567, 203.45674, 50,
                                Eigen::Vector3d(0.006, 0.005, 0.012)};
  tags.height_above_start_m = 70.123;
  tags.gimbal_yaw_deg = 12.34;
  tags.gimbal_pitch_deg = -90.0;
  tags.gimbal_roll_deg = 0.0;
  tags.velocity_north_east_down_m_s = Eigen::Vector3d(0.1, -0.2, -2);
  return tags;
}

class PhotoWriter : public testing::Test {
 protected:
  void SetUp() override {
    folder =
        fs::temp_directory_path() / ("photo_writer_" + std::to_string(::getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder;
};

// What the exiv2 program prints of a file's EXIF (-PEkv) and XMP (-PXkv); empty where there is no
// such program.
std::string told_by_exiv2(const fs::path& photo) {
  if (std::system("command -v exiv2 >/dev/null 2>&1") != 0) return "";
  const std::string name = photo.string();
  const std::string command = "(exiv2 -q -PEkv " + name + "; exiv2 -q -PXkv " + name + ") 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string text;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  pclose(pipe);
  return text;
}

TEST_F(PhotoWriter, WritesTagsThatTheExiv2ProgramReads) {
  const auto bytes = with_tags(small_jpeg(), sample_tags());
  ASSERT_TRUE(bytes.ok()) << bytes.error().sentence;
  ASSERT_TRUE(write_whole_file(folder / "a.jpg", *bytes).ok());
  const std::string told = told_by_exiv2(folder / "a.jpg");
  if (told.empty()) GTEST_SKIP() << "the exiv2 program is not installed";
  // Local time is a day later than UTC here.
  EXPECT_THAT(told, testing::ContainsRegex("DateTimeOriginal +2026:04:18 08:59:58"));
  EXPECT_THAT(told, testing::ContainsRegex("SubSecTimeOriginal +047"));
  EXPECT_THAT(told, testing::ContainsRegex("OffsetTimeOriginal +\\+09:00"));
  EXPECT_THAT(told, testing::ContainsRegex("GPSDateStamp +2026:04:17"));
  EXPECT_THAT(told, testing::ContainsRegex("GPSTimeStamp +23/1 59/1 58047/1000"));
  // By hand: 0.3612345678 deg = 21.674074068 min; 0.674074068 min = 40.44444408 s.
  EXPECT_THAT(told, testing::ContainsRegex("GPSLatitude +35/1 21/1 404444441/10000000"));
  EXPECT_THAT(told, testing::ContainsRegex("GPSLatitudeRef +N"));
  // By hand: 0.1301234567 deg = 7.807407402 min; 0.807407402 min = 48.44444412 s.
  EXPECT_THAT(told, testing::ContainsRegex("GPSLongitude +139/1 7/1 484444441/10000000"));
  EXPECT_THAT(told, testing::ContainsRegex("GPSLongitudeRef +W"));
  EXPECT_THAT(told, testing::ContainsRegex("GPSAltitude +2034567/10000"));
  EXPECT_THAT(told, testing::ContainsRegex("GPSMapDatum +WGS-84"));
  // By hand: 10000 / 1.88 = 5319.1489 px/cm; diagonal 4589.39 px * 1.88 um = 8.628 mm;
  // 3.995 * 43.267 / 8.628 = 20.03.
  EXPECT_THAT(told, testing::ContainsRegex("FocalPlaneXResolution +53191489/10000"));
  EXPECT_THAT(told, testing::ContainsRegex("FocalLengthIn35mmFilm +20"));
  EXPECT_THAT(told, testing::ContainsRegex("FocalLength +39950/10000"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.RtkFlag +50"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.RtkStdLon +0.00600"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.RtkStdLat +0.00500"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.RtkStdHgt +0.01200"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.GpsLatitude +35.36123456780"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.GpsLongitude +-139.13012345670"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.AbsoluteAltitude +\\+203.4567"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.GimbalYawDegree +\\+12.3"));
  EXPECT_THAT(told, testing::ContainsRegex("drone-dji.FlightZSpeed +-2.00"));
}

TEST_F(PhotoWriter, LeavesOutWhatIsNotKnown) {
  PhotoTags tags = sample_tags();
  tags.position.reset();
  tags.gimbal_yaw_deg.reset();
  const auto bytes = with_tags(small_jpeg(), tags);
  ASSERT_TRUE(bytes.ok());
  ASSERT_TRUE(write_whole_file(folder / "a.jpg", *bytes).ok());
  const std::string told = told_by_exiv2(folder / "a.jpg");
  if (told.empty()) GTEST_SKIP() << "the exiv2 program is not installed";
  EXPECT_THAT(told, Not(HasSubstr("GPS")));
  EXPECT_THAT(told, Not(HasSubstr("Rtk")));
  EXPECT_THAT(told, Not(HasSubstr("GimbalYaw")));
  EXPECT_THAT(told, HasSubstr("GimbalPitchDegree"));
}

TEST_F(PhotoWriter, LeavesThePixelsAsTheyAre) {
  const auto before = small_jpeg();
  const auto bytes = with_tags(before, sample_tags());
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ(jpeg::decode_rgb(*bytes, "a")->data, jpeg::decode_rgb(before, "b")->data);
}

TEST_F(PhotoWriter, GivesTheSameBytesTwice) {
  EXPECT_EQ(*with_tags(small_jpeg(), sample_tags()), *with_tags(small_jpeg(), sample_tags()));
}

TEST_F(PhotoWriter, RefusesWhatIsNoJpeg) {
  const std::vector<std::uint8_t> text{'h', 'e', 'l', 'l', 'o'};
  const auto bytes = with_tags(text, sample_tags());
  ASSERT_FALSE(bytes.ok());
  EXPECT_THAT(bytes.error().sentence, HasSubstr("tags cannot be written"));
}

TEST_F(PhotoWriter, LeavesNothingBehindWhereAFileCannotBeWritten) {
  fs::create_directories(folder / "taken.csv" / "by a folder");
  const auto status = write_whole_file(folder / "taken.csv", std::string("text"));
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().sentence, HasSubstr("taken.csv cannot be written: "));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace plumbline::deliver
