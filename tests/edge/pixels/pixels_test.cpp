// SPDX-License-Identifier: MIT
#include "edge/pixels/pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "edge/jpeg/jpeg.h"
#include "tests/edge/pixels/largest_difference.h"
#include "tests/edge/pixels/random_frame.h"

namespace plumbline::pixels {
namespace {

using ::testing::HasSubstr;

cv::Mat matrix_over(RandomFrame& frame, int rows, int width, int type) {
  return {rows, width, type, frame.bytes.data(), frame.image.stride_bytes};
}

// What lies outside 16..235 we clip before the colours are joined, OpenCV after it: kept out here.
void make_limited(RandomFrame& frame) {
  frame.image.range = LumaRange::kLimited;
  for (std::uint8_t& byte : frame.bytes) byte = static_cast<std::uint8_t>(16 + byte % 220);
}

// Ours rounds Y and colours to full range before it goes on to red, green and blue: 0.5 for Y,
// 0.5 * 1.772 for the colour, and each side's last rounding.
constexpr int kRoundedTwice = 2;

TEST(Pixels, AgreesWithOpenCvOnYuyvOfLimitedRange) {
  RandomFrame frame(PixelFormat::kYuyv, 66, 20, 12, 1);
  make_limited(frame);
  cv::Mat reference;
  cv::cvtColor(matrix_over(frame, 20, 66, CV_8UC2), reference, cv::COLOR_YUV2RGB_YUYV);
  const auto rgb = rgb_of(frame.image);
  ASSERT_TRUE(rgb) << rgb.error().sentence;
  EXPECT_LE(largest_difference(*rgb, reference), kRoundedTwice);
}

TEST(Pixels, AgreesWithOpenCvOnNv12OfLimitedRange) {
  RandomFrame frame(PixelFormat::kNv12, 66, 20, 0, 2);
  make_limited(frame);
  cv::Mat reference;
  cv::cvtColor(matrix_over(frame, 30, 66, CV_8UC1), reference, cv::COLOR_YUV2RGB_NV12);
  const auto rgb = rgb_of(frame.image);
  ASSERT_TRUE(rgb) << rgb.error().sentence;
  EXPECT_LE(largest_difference(*rgb, reference), kRoundedTwice);
}

TEST(Pixels, AgreesWithOpenCvOnNv12OfFullRange) {
  RandomFrame frame(PixelFormat::kNv12, 40, 20, 24, 3);
  cv::Mat ycrcb(20, 40, CV_8UC3);
  for (int v = 0; v < 20; ++v) {
    for (int u = 0; u < 40; ++u) {
      const std::size_t stride = frame.image.stride_bytes;
      const std::size_t chroma = frame.image.second_plane_offset +
                                 static_cast<std::size_t>(v / 2) * stride +
                                 static_cast<std::size_t>(u / 2 * 2);
      ycrcb.at<cv::Vec3b>(v, u) = {
          frame.bytes[static_cast<std::size_t>(v) * stride + static_cast<std::size_t>(u)],
          frame.bytes[chroma + 1], frame.bytes[chroma]};
    }
  }
  cv::Mat reference;
  cv::cvtColor(ycrcb, reference, cv::COLOR_YCrCb2RGB);
  const auto rgb = rgb_of(frame.image);
  ASSERT_TRUE(rgb) << rgb.error().sentence;
  EXPECT_LE(largest_difference(*rgb, reference), 1);
}

TEST(Pixels, TakesGreyFromLumaAloneAndWidensTheLimitedRange) {
  RandomFrame frame(PixelFormat::kYuyv, 4, 1, 0, 4);
  frame.bytes = {16, 200, 235, 10, 126, 128, 5, 128};
  frame.image.bytes = frame.bytes;
  EXPECT_EQ(grey_of(frame.image)->data, (std::vector<std::uint8_t>{16, 235, 126, 5}));
  frame.image.range = LumaRange::kLimited;
  EXPECT_EQ(grey_of(frame.image)->data, (std::vector<std::uint8_t>{0, 255, 128, 0}));
}

TEST(Pixels, WeighsColoursToGreyAsOpenCvDoes) {
  RandomFrame frame(PixelFormat::kRgb24, 31, 17, 5, 10);
  cv::Mat reference;
  cv::cvtColor(matrix_over(frame, 17, 31, CV_8UC3), reference, cv::COLOR_RGB2GRAY);
  EXPECT_LE(largest_difference(*grey_of(frame.image), reference), 1);
}

// A JPEG of smooth content at quality 100 keeps the camera's own Y within its rounding.
TEST(Pixels, WritesTheCamerasOwnLumaIntoTheJpeg) {
  for (const PixelFormat format : {PixelFormat::kYuyv, PixelFormat::kNv12, PixelFormat::kGrey}) {
    RandomFrame frame(format, 70, 22, 10, 11);
    for (std::size_t i = 0; i < frame.bytes.size(); ++i) {
      frame.bytes[i] = static_cast<std::uint8_t>(100 + i / frame.image.stride_bytes);
    }
    const auto file = jpeg_of(frame.image, 100);
    ASSERT_TRUE(file) << file.error().sentence;
    const auto read = jpeg::decode_grey(*file, "test");
    ASSERT_TRUE(read) << read.error().sentence;
    const auto grey = grey_of(frame.image);
    const cv::Mat reference(22, 70, CV_8UC1, const_cast<std::uint8_t*>(grey->data.data()));
    EXPECT_LE(largest_difference(*read, reference), 2) << name_of(format);
  }
}

TEST(Pixels, WritesTheSameColoursIntoTheJpegAsIntoTheImage) {
  RandomFrame frame(PixelFormat::kNv12, 64, 32, 0, 12);
  std::fill(frame.bytes.begin(), frame.bytes.begin() + 64 * 32, std::uint8_t{120});
  for (std::size_t i = 64 * 32; i < frame.bytes.size(); i += 2) {
    frame.bytes[i] = 90;
    frame.bytes[i + 1] = 170;
  }
  const auto read = jpeg::decode_rgb(*jpeg_of(frame.image, 95), "test");
  const auto rgb = rgb_of(frame.image);
  ASSERT_TRUE(read);
  const cv::Mat reference(32, 64, CV_8UC3, const_cast<std::uint8_t*>(rgb->data.data()));
  EXPECT_LE(largest_difference(*read, reference), 3);
}

TEST(Pixels, PassesAWholeJpegThroughAndRefusesACutOne) {
  RandomFrame source(PixelFormat::kGrey, 64, 48, 0, 13);
  const std::vector<std::uint8_t> file = *jpeg_of(source.image, 90);
  RawImage frame{PixelFormat::kMjpeg, 64, 48, 0, 0, LumaRange::kFull, file};
  EXPECT_EQ(*jpeg_of(frame, 50), file);
  frame.bytes = std::span(file).first(file.size() / 2);
  EXPECT_THAT(jpeg_of(frame, 50).error().sentence, HasSubstr("without an end"));
  frame.bytes = file;
  frame.width_px = 32;
  EXPECT_THAT(grey_of(frame).error().sentence, HasSubstr("in a stream of 32 x 48"));
}

// A grey frame of one table of each class, whose segments libjpeg writes one after the other.
TEST(Pixels, GivesAFrameOfACameraTheTablesThatMakeItAFile) {
  RandomFrame source(PixelFormat::kGrey, 64, 48, 0, 14);
  const std::vector<std::uint8_t> file = *jpeg_of(source.image, 90);
  const std::vector<std::uint8_t> marker = {0xFF, 0xC4};
  std::vector<std::uint8_t> frame = file;
  for (int table = 0; table < 2; ++table) {
    const auto at = std::search(frame.begin(), frame.end(), marker.begin(), marker.end());
    ASSERT_NE(at, frame.end());
    frame.erase(at, at + 2 + at[2] * 256 + at[3]);
  }
  const RawImage of_camera{PixelFormat::kMjpeg, 64, 48, 0, 0, LumaRange::kFull, frame};
  const auto photo = jpeg_of(of_camera, 90);
  ASSERT_TRUE(photo) << photo.error().sentence;
  EXPECT_NE(std::search(photo->begin(), photo->end(), marker.begin(), marker.end()), photo->end());
  EXPECT_EQ(jpeg::decode_grey(*photo, "photo")->data, jpeg::decode_grey(file, "file")->data);
}

TEST(Pixels, RefusesAFrameThatLacksItsLastByte) {
  for (const PixelFormat format :
       {PixelFormat::kGrey, PixelFormat::kYuyv, PixelFormat::kNv12, PixelFormat::kRgb24}) {
    RandomFrame frame(format, 16, 8, 0, 14);
    EXPECT_TRUE(grey_of(frame.image)) << name_of(format);
    frame.image.bytes = frame.image.bytes.first(frame.bytes.size() - 1);
    EXPECT_THAT(grey_of(frame.image).error().sentence, HasSubstr("cut short")) << name_of(format);
    EXPECT_FALSE(rgb_of(frame.image));
    EXPECT_FALSE(jpeg_of(frame.image, 90));
  }
}

TEST(Pixels, RefusesSizesThatAFormatCannotHave) {
  RandomFrame frame(PixelFormat::kRggb8, 16, 8, 0, 15);
  frame.image.width_px = 15;
  EXPECT_THAT(rgb_of(frame.image).error().sentence, HasSubstr("odd size"));
  frame.image.width_px = 0;
  EXPECT_THAT(rgb_of(frame.image).error().sentence, HasSubstr("not possible"));
  frame.image.width_px = 18;
  EXPECT_THAT(rgb_of(frame.image).error().sentence, HasSubstr("claims rows of 16 bytes"));
}

}  // namespace
}  // namespace plumbline::pixels
