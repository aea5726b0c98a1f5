// SPDX-License-Identifier: MIT
#include "edge/pixels/pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>

#include "edge/jpeg/jpeg.h"
#include "tests/edge/pixels/random_frame.h"

namespace plumbline::pixels {
namespace {

using ::testing::HasSubstr;

int largest_difference(const Image& image, const cv::Mat& reference, int border = 0) {
  int largest = 0;
  for (int v = border; v < image.height_px - border; ++v) {
    for (int u = border; u < image.width_px - border; ++u) {
      for (int c = 0; c < image.channels; ++c) {
        const int ours = image.data[image.index(u, v) + static_cast<std::size_t>(c)];
        const int theirs = reference.ptr<std::uint8_t>(v)[u * image.channels + c];
        largest = std::max(largest, std::abs(ours - theirs));
      }
    }
  }
  return largest;
}

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

TEST(Pixels, DemosaicsAsOpenCvDoesWithinTheBorder) {
  RandomFrame frame(PixelFormat::kRggb8, 64, 48, 8, 5);
  cv::Mat reference;
  // OpenCV names a pattern by the second row's second and third sample: RGGB is BG.
  cv::cvtColor(matrix_over(frame, 48, 64, CV_8UC1), reference, cv::COLOR_BayerBG2RGB);
  const auto rgb = rgb_of(frame.image);
  ASSERT_TRUE(rgb) << rgb.error().sentence;
  EXPECT_EQ(largest_difference(*rgb, reference, 1), 0);
}

TEST(Pixels, DemosaicsAFlatColourFlatUpToTheBorder) {
  RandomFrame frame(PixelFormat::kRggb8, 8, 6, 0, 6);
  for (std::size_t i = 0; i < frame.bytes.size(); ++i) {
    const std::size_t u = i % 8;
    const std::size_t v = i / 8;
    frame.bytes[i] = (u + v) % 2 == 1 ? 120 : v % 2 == 0 ? 200 : 40;
  }
  const auto rgb = rgb_of(frame.image);
  ASSERT_TRUE(rgb);
  for (std::size_t i = 0; i < rgb->data.size(); i += 3) {
    EXPECT_EQ(rgb->data[i], 200);
    EXPECT_EQ(rgb->data[i + 1], 120);
    EXPECT_EQ(rgb->data[i + 2], 40);
  }
}

// The same samples in 8 bits, in 10 of 16, and in 10 packed must give the same image.
TEST(Pixels, KeepsTheUpperEightOfTenBitsPackedOrNot) {
  RandomFrame of_8(PixelFormat::kRggb8, 12, 4, 0, 7);
  RandomFrame of_10(PixelFormat::kRggb10, 12, 4, 6, 8);
  RandomFrame packed(PixelFormat::kRggb10Packed, 12, 4, 1, 9);  // lower bits stay noise
  for (std::size_t v = 0; v < 4; ++v) {
    for (std::size_t u = 0; u < 12; ++u) {
      const unsigned sample = 4u * of_8.bytes[12 * v + u] + (u % 4);
      std::uint8_t* pair = &of_10.bytes[of_10.image.stride_bytes * v + 2 * u];
      pair[0] = static_cast<std::uint8_t>(sample);
      pair[1] = static_cast<std::uint8_t>(sample >> 8);
      packed.bytes[packed.image.stride_bytes * v + u / 4 * 5 + u % 4] =
          static_cast<std::uint8_t>(sample >> 2);
    }
  }
  EXPECT_EQ(rgb_of(of_10.image)->data, rgb_of(of_8.image)->data);
  EXPECT_EQ(rgb_of(packed.image)->data, rgb_of(of_8.image)->data);
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

TEST(Pixels, RefusesAFrameThatLacksItsLastByte) {
  for (const PixelFormat format :
       {PixelFormat::kGrey, PixelFormat::kYuyv, PixelFormat::kNv12, PixelFormat::kRgb24,
        PixelFormat::kRggb8, PixelFormat::kRggb10, PixelFormat::kRggb10Packed}) {
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

TEST(PixelFormat, IsNamedInEitherCase) {
  EXPECT_EQ(*pixel_format_of("nv12"), PixelFormat::kNv12);
  EXPECT_EQ(*pixel_format_of("praa"), PixelFormat::kRggb10Packed);
  EXPECT_THAT(pixel_format_of("H264").error().sentence, HasSubstr("GREY, YUYV, NV12"));
}

}  // namespace
}  // namespace plumbline::pixels
