// SPDX-License-Identifier: MIT
#include "edge/pixels/bayer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <string>

#include "edge/jpeg/jpeg.h"
#include "edge/pixels/pixels.h"
#include "tests/edge/pixels/bayer_frame.h"
#include "tests/edge/pixels/largest_difference.h"

namespace plumbline::pixels {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::uint16_t> first_row(PixelFormat format, int width,
                                     const std::vector<std::uint8_t>& bytes) {
  const RawImage frame{format, width, 1, bytes.size(), 0, LumaRange::kFull, bytes};
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(width));
  bayer_row(frame, bayer_of(format).value(), 0, samples.data());
  return samples;
}

// OpenCV names a pattern by the second row's second and third sample.
int opencv_code(BayerOrder order) {
  switch (order) {
    case BayerOrder::kRggb:
      return cv::COLOR_BayerBG2RGB;
    case BayerOrder::kGrbg:
      return cv::COLOR_BayerGB2RGB;
    case BayerOrder::kGbrg:
      return cv::COLOR_BayerGR2RGB;
    case BayerOrder::kBggr:
      return cv::COLOR_BayerRG2RGB;
  }
  return -1;
}

cv::Mat demosaiced_by_opencv(const BayerFrame& frame) {
  const BayerLayout layout = bayer_of(frame.image.format).value();
  cv::Mat upper(frame.image.height_px, frame.image.width_px, CV_8UC1);
  for (std::size_t i = 0; i < frame.samples.size(); ++i) {
    upper.data[i] = static_cast<std::uint8_t>(frame.samples[i] >> (layout.bits - 8));
  }
  cv::Mat rgb;
  cv::cvtColor(upper, rgb, opencv_code(layout.order));
  return rgb;
}

// Worked by hand from MIPI CSI-2's figures of RAW10 and RAW12.
TEST(Bayer, UnpacksFourSamplesOfTenBitsFromFiveBytes) {
  const auto samples = first_row(PixelFormat::kRggb10Packed, 4, {0xFF, 0x00, 0x55, 0xAA, 0x93});
  EXPECT_THAT(samples, ElementsAre(1023, 0, 341, 682));
}

TEST(Bayer, UnpacksTwoSamplesOfTwelveBitsFromThreeBytes) {
  const auto samples =
      first_row(PixelFormat::kBggr12Packed, 4, {0xAB, 0x12, 0x3C, 0x00, 0xFF, 0xF1});
  EXPECT_THAT(samples, ElementsAre(0xABC, 0x123, 0x001, 0xFFF));
}

TEST(Bayer, UnpacksARowThatEndsWithinAPack) {
  const auto samples =
      first_row(PixelFormat::kGrbg10Packed, 6, {0, 0, 0, 0, 0, 0x80, 0x40, 0, 0, 0x0D});
  EXPECT_THAT(samples, ElementsAre(0, 0, 0, 0, 513, 259));
}

TEST(Bayer, TakesNoBitsFromAboveASample) {
  EXPECT_THAT(first_row(PixelFormat::kGbrg10, 2, {0x34, 0xFE, 0xFF, 0x03}),
              ElementsAre(0x234, 0x3FF));
  EXPECT_THAT(first_row(PixelFormat::kGbrg12, 2, {0x34, 0xFE, 0xFF, 0x0F}),
              ElementsAre(0xE34, 0xFFF));
  EXPECT_THAT(first_row(PixelFormat::kGbrg16, 2, {0x34, 0xFE, 0xFF, 0xFF}),
              ElementsAre(0xFE34, 0xFFFF));
}

TEST(Bayer, DemosaicsEveryFormatAsOpenCvDoesWithinTheBorder) {
  for (const PixelFormat format : all_bayer_formats()) {
    const BayerFrame frame = random_bayer_frame(format, 66, 48, 5);
    const auto rgb = rgb_of(frame.image);
    ASSERT_TRUE(rgb) << rgb.error().sentence;
    EXPECT_EQ(largest_difference(*rgb, demosaiced_by_opencv(frame), 1), 0) << name_of(format);
  }
}

TEST(Bayer, WeighsEveryFormatToGreyAsOpenCvDoes) {
  for (const PixelFormat format : all_bayer_formats()) {
    const BayerFrame frame = random_bayer_frame(format, 66, 48, 6);
    cv::Mat grey;
    cv::cvtColor(demosaiced_by_opencv(frame), grey, cv::COLOR_RGB2GRAY);
    EXPECT_LE(largest_difference(*grey_of(frame.image), grey, 1), 1) << name_of(format);
  }
}

// Red 200, green 120, blue 40 of 255, in every order and depth; in the JPEG within its rounding.
TEST(Bayer, KeepsAFlatColourFlatUpToTheBorderAndInTheJpeg) {
  for (const PixelFormat format : all_bayer_formats()) {
    const BayerLayout layout = bayer_of(format).value();
    const std::string order = "RGGBGRBGGBRGBGGR";
    std::vector<std::uint16_t> samples(16 * 8);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t site = i / 16 % 2 * 2 + i % 2;
      const char colour = order[4 * static_cast<std::size_t>(layout.order) + site];
      const int value = colour == 'R' ? 200 : colour == 'G' ? 120 : 40;
      samples[i] = static_cast<std::uint16_t>(value << (layout.bits - 8));
    }
    const BayerFrame frame(format, 16, 8, samples);
    const cv::Mat flat(8, 16, CV_8UC3, cv::Scalar(200, 120, 40));
    EXPECT_EQ(largest_difference(*rgb_of(frame.image), flat), 0) << name_of(format);
    const auto photo = jpeg::decode_rgb(*jpeg_of(frame.image, 100), "photo");
    ASSERT_TRUE(photo) << photo.error().sentence;
    EXPECT_LE(largest_difference(*photo, flat), 2) << name_of(format);
  }
}

TEST(Bayer, RefusesAFrameThatLacksItsLastByte) {
  for (const PixelFormat format : all_bayer_formats()) {
    BayerFrame frame(format, 8, 2, std::vector<std::uint16_t>(16), 0);
    EXPECT_TRUE(grey_of(frame.image)) << name_of(format);
    frame.image.bytes = frame.image.bytes.first(frame.bytes.size() - 1);
    EXPECT_THAT(grey_of(frame.image).error().sentence, HasSubstr("cut short")) << name_of(format);
  }
}

}  // namespace
}  // namespace plumbline::pixels
