// SPDX-License-Identifier: MIT
#include "edge/base/pixel_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <utility>
#include <vector>

namespace plumbline {
namespace {

using ::testing::HasSubstr;

TEST(PixelFormat, IsNamedInEitherCase) {
  EXPECT_EQ(*pixel_format_of("nv12"), PixelFormat::kNv12);
  EXPECT_EQ(*pixel_format_of("praa"), PixelFormat::kRggb10Packed);
  EXPECT_THAT(pixel_format_of("H264").error().sentence, HasSubstr("GREY, YUYV, NV12"));
}

TEST(PixelFormat, IsNamedByItsLongNameToo) {
  EXPECT_EQ(*pixel_format_of("SRGGB10"), PixelFormat::kRggb10);
  EXPECT_EQ(*pixel_format_of("SGBRG12P"), PixelFormat::kGbrg12Packed);
  EXPECT_EQ(*pixel_format_of("sbggr16"), PixelFormat::kBggr16);
}

TEST(PixelFormat, IsNotGuessedWhereTheCaseDecides) {
  EXPECT_EQ(*pixel_format_of("pGAA"), PixelFormat::kGbrg10Packed);
  EXPECT_EQ(*pixel_format_of("pgAA"), PixelFormat::kGrbg10Packed);
  EXPECT_THAT(pixel_format_of("pgaa").error().sentence, HasSubstr("pgAA or pGAA"));
}

// The kernel's header against our letters.
TEST(PixelFormat, HasTheKernelsCode) {
  const std::vector<std::pair<PixelFormat, std::uint32_t>> kernel = {
      {PixelFormat::kGrey, V4L2_PIX_FMT_GREY},
      {PixelFormat::kYuyv, V4L2_PIX_FMT_YUYV},
      {PixelFormat::kNv12, V4L2_PIX_FMT_NV12},
      {PixelFormat::kMjpeg, V4L2_PIX_FMT_MJPEG},
      {PixelFormat::kRgb24, V4L2_PIX_FMT_RGB24},
      {PixelFormat::kRggb8, V4L2_PIX_FMT_SRGGB8},
      {PixelFormat::kGrbg8, V4L2_PIX_FMT_SGRBG8},
      {PixelFormat::kGbrg8, V4L2_PIX_FMT_SGBRG8},
      {PixelFormat::kBggr8, V4L2_PIX_FMT_SBGGR8},
      {PixelFormat::kRggb10, V4L2_PIX_FMT_SRGGB10},
      {PixelFormat::kGrbg10, V4L2_PIX_FMT_SGRBG10},
      {PixelFormat::kGbrg10, V4L2_PIX_FMT_SGBRG10},
      {PixelFormat::kBggr10, V4L2_PIX_FMT_SBGGR10},
      {PixelFormat::kRggb10Packed, V4L2_PIX_FMT_SRGGB10P},
      {PixelFormat::kGrbg10Packed, V4L2_PIX_FMT_SGRBG10P},
      {PixelFormat::kGbrg10Packed, V4L2_PIX_FMT_SGBRG10P},
      {PixelFormat::kBggr10Packed, V4L2_PIX_FMT_SBGGR10P},
      {PixelFormat::kRggb12, V4L2_PIX_FMT_SRGGB12},
      {PixelFormat::kGrbg12, V4L2_PIX_FMT_SGRBG12},
      {PixelFormat::kGbrg12, V4L2_PIX_FMT_SGBRG12},
      {PixelFormat::kBggr12, V4L2_PIX_FMT_SBGGR12},
      {PixelFormat::kRggb12Packed, V4L2_PIX_FMT_SRGGB12P},
      {PixelFormat::kGrbg12Packed, V4L2_PIX_FMT_SGRBG12P},
      {PixelFormat::kGbrg12Packed, V4L2_PIX_FMT_SGBRG12P},
      {PixelFormat::kBggr12Packed, V4L2_PIX_FMT_SBGGR12P},
      {PixelFormat::kRggb16, V4L2_PIX_FMT_SRGGB16},
      {PixelFormat::kGrbg16, V4L2_PIX_FMT_SGRBG16},
      {PixelFormat::kGbrg16, V4L2_PIX_FMT_SGBRG16},
      {PixelFormat::kBggr16, V4L2_PIX_FMT_SBGGR16},
  };
  for (const auto& [format, code] : kernel) {
    EXPECT_EQ(code_of(format), code) << name_of(format);
    EXPECT_EQ(pixel_format_of_code(code), format) << name_of(format);
  }
}

}  // namespace
}  // namespace plumbline
