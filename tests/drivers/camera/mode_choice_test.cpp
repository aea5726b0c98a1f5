// SPDX-License-Identifier: MIT
#include "drivers/camera/mode_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumbline {
namespace {

using ::testing::HasSubstr;

const std::vector<CameraMode> kWebcam = {{640, 480, PixelFormat::kYuyv, 30.0},
                                         {1920, 1080, PixelFormat::kYuyv, 5.0},
                                         {1920, 1080, PixelFormat::kMjpeg, 30.0},
                                         {1920, 1080, PixelFormat::kGrey, 30.0},
                                         {1280, 720, PixelFormat::kMjpeg, 60.0}};

TEST(ModeChoice, TakesTheLargestSizeInAFormatThatIsFastEnough) {
  const auto mode = choose_mode(kWebcam, {});
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->width_px, 1920);
  EXPECT_EQ(mode->format, PixelFormat::kMjpeg);
}

TEST(ModeChoice, TakesTheBetterFormatWhereItsRateIsEnough) {
  CameraOptions options;
  options.frames_per_s = 5;
  EXPECT_EQ(choose_mode(kWebcam, options)->format, PixelFormat::kYuyv);
}

TEST(ModeChoice, TakesTheFastestWhereNoneIsEnough) {
  CameraOptions options;
  options.frames_per_s = 100;
  options.width_px = 1920;
  EXPECT_EQ(choose_mode(kWebcam, options)->frames_per_s, 30.0);
}

TEST(ModeChoice, KeepsToWhatIsAskedFor) {
  CameraOptions options;
  options.width_px = 640;
  options.height_px = 480;
  options.format = PixelFormat::kYuyv;
  EXPECT_EQ(choose_mode(kWebcam, options)->width_px, 640);
}

TEST(ModeChoice, TriesASizeBetweenThoseListed) {
  CameraOptions options;
  options.width_px = 1000;
  options.height_px = 700;
  const auto mode = choose_mode(kWebcam, options);
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->width_px, 1000);
  EXPECT_EQ(mode->height_px, 700);
}

TEST(ModeChoice, SaysWhatThereIsWhereNothingFits) {
  CameraOptions options;
  options.format = PixelFormat::kNv12;
  EXPECT_THAT(choose_mode(kWebcam, options).error().sentence,
              HasSubstr("no mode NV12; it has 1920 x 1080 YUYV"));
  EXPECT_THAT(choose_mode({}, {}).error().sentence, HasSubstr("no pixel format"));
}

const std::vector<CameraMode> kSensor = {{4056, 3040, PixelFormat::kNv12, 10.0},
                                         {4056, 3040, PixelFormat::kBggr10Packed, 10.0},
                                         {4056, 3040, PixelFormat::kBggr12, 8.0},
                                         {4056, 3040, PixelFormat::kBggr12Packed, 8.0},
                                         {2028, 1520, PixelFormat::kBggr16, 40.0}};

TEST(ModeChoice, TakesAllBitsInTheFewestBytesWhereRawFramesAreWanted) {
  CameraOptions options;
  EXPECT_EQ(choose_mode(kSensor, options)->format, PixelFormat::kNv12);
  options.raw = true;
  EXPECT_EQ(choose_mode(kSensor, options)->format, PixelFormat::kBggr12Packed);
  EXPECT_EQ(choose_mode(kSensor, options)->width_px, 4056);
}

TEST(ModeChoice, SaysWhereThereAreNoRawFrames) {
  CameraOptions options;
  options.raw = true;
  EXPECT_THAT(choose_mode(kWebcam, options).error().sentence,
              HasSubstr("no mode of raw frames; it has 1920 x 1080 YUYV"));
}

}  // namespace
}  // namespace plumbline
