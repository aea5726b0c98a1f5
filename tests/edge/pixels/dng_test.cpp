// SPDX-License-Identifier: MIT
#include "edge/pixels/dng.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libraw/libraw.h>

#include <memory>
#include <string>

#include "tests/edge/pixels/bayer_frame.h"

namespace plumbline::pixels {
namespace {

using ::testing::HasSubstr;

// LibRaw, which darktable, RawTherapee and others read raw files with; opened and unpacked.
std::unique_ptr<LibRaw> read(const std::vector<std::uint8_t>& file) {
  auto reader = std::make_unique<LibRaw>();
  const int opened = reader->open_buffer(const_cast<std::uint8_t*>(file.data()), file.size());
  EXPECT_EQ(opened, LIBRAW_SUCCESS) << libraw_strerror(opened);
  const int unpacked = reader->unpack();
  EXPECT_EQ(unpacked, LIBRAW_SUCCESS) << libraw_strerror(unpacked);
  return reader;
}

const DngFacts kFacts = {"Sensor 477",
                         {{{0.0625, 0.0635, 0.0645, 0.0655}}, {{2.0, 1.6}}},
                         std::chrono::microseconds(1250)};

// The colours of the first two rows' first two, as LibRaw sees them.
std::string order_of(LibRaw& reader) {
  std::string order;
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 2; ++u) order += reader.imgdata.idata.cdesc[reader.COLOR(v, u)];
  }
  return order;
}

// The black level of the sample at (u, v) in all: LibRaw keeps what is common apart.
unsigned black_at(const LibRaw& reader, int u, int v) {
  const auto& levels = reader.imgdata.color;
  const unsigned site = 6 + static_cast<unsigned>(v) % levels.cblack[4] * levels.cblack[5] +
                        static_cast<unsigned>(u) % levels.cblack[5];
  return levels.black + levels.cblack[site];
}

TEST(Dng, GivesEverySampleOfEveryFormatToARawConverter) {
  for (const PixelFormat format : all_bayer_formats()) {
    const BayerFrame frame = random_bayer_frame(format, 66, 48, 3);
    const auto file = dng_of(frame.image, {"Sensor 477", {}, {}});
    ASSERT_TRUE(file) << file.error().sentence;
    const auto reader = read(*file);
    ASSERT_EQ(reader->imgdata.sizes.raw_width, 66) << name_of(format);
    ASSERT_EQ(reader->imgdata.sizes.raw_height, 48) << name_of(format);
    const std::uint16_t* samples = reader->imgdata.rawdata.raw_image;
    ASSERT_NE(samples, nullptr) << name_of(format);
    EXPECT_EQ(std::vector<std::uint16_t>(samples, samples + 66 * 48), frame.samples)
        << name_of(format);
    EXPECT_EQ(reader->imgdata.color.maximum, (1u << bayer_of(format)->bits) - 1);
  }
}

TEST(Dng, SaysWhichColourEachSampleHas) {
  for (const auto& [format, order] :
       {std::pair(PixelFormat::kRggb8, "RGGB"), std::pair(PixelFormat::kGrbg10Packed, "GRBG"),
        std::pair(PixelFormat::kGbrg12, "GBRG"), std::pair(PixelFormat::kBggr16, "BGGR")}) {
    const auto reader = read(*dng_of(random_bayer_frame(format, 66, 48, 4).image, kFacts));
    EXPECT_EQ(order_of(*reader), order);
  }
}

// Of 12 bits: 4096 times 0.0625 for red, 0.0635 and 0.0645 for green, 0.0655 for blue.
TEST(Dng, SaysTheBlackLevelOfEachColourWhereItIs) {
  const auto reader =
      read(*dng_of(random_bayer_frame(PixelFormat::kGbrg12, 66, 48, 5).image, kFacts));
  EXPECT_NEAR(black_at(*reader, 0, 1), 256.0, 0.6);
  EXPECT_NEAR(black_at(*reader, 1, 1), 260.1, 0.6);
  EXPECT_NEAR(black_at(*reader, 0, 0), 264.2, 0.6);
  EXPECT_NEAR(black_at(*reader, 1, 0), 268.3, 0.6);
}

TEST(Dng, SaysWhatGreyLooksLikeToTheSensor) {
  const auto reader =
      read(*dng_of(random_bayer_frame(PixelFormat::kRggb10, 66, 48, 6).image, kFacts));
  const float* gains = reader->imgdata.color.cam_mul;
  EXPECT_NEAR(gains[0] / gains[1], 2.0, 1e-4);
  EXPECT_NEAR(gains[2] / gains[1], 1.6, 1e-4);
}

TEST(Dng, SaysCameraAndExposure) {
  const auto reader =
      read(*dng_of(random_bayer_frame(PixelFormat::kRggb10, 66, 48, 7).image, kFacts));
  EXPECT_EQ(std::string(reader->imgdata.idata.make) + " " + reader->imgdata.idata.model,
            "Sensor 477");
  EXPECT_NEAR(reader->imgdata.other.shutter, 0.00125, 1e-6);
  EXPECT_EQ(reader->imgdata.idata.dng_version, 0x01040000u);
}

// Grey in daylight, through black levels, gains, matrix and gamma of the converter.
TEST(Dng, OfAGreySurfaceBecomesGreyInARawConverter) {
  const double gains[3] = {2.0, 1.0, 1.6};
  const std::size_t colour_of_site[4] = {0, 1, 1, 2};
  std::vector<std::uint16_t> samples(64 * 48);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t site = i / 64 % 2 * 2 + i % 2;
    const double light = 0.3 / gains[colour_of_site[site]];
    const double black = (*kFacts.colour.black)[site];
    samples[i] = static_cast<std::uint16_t>(4096 * black + 4096 * (1 - black) * light);
  }
  const BayerFrame frame(PixelFormat::kRggb12, 64, 48, samples);
  const auto reader = read(*dng_of(frame.image, kFacts));
  reader->imgdata.params.use_camera_wb = 1;
  reader->imgdata.params.no_auto_bright = 1;
  ASSERT_EQ(reader->dcraw_process(), LIBRAW_SUCCESS);
  const std::uint16_t* middle = reader->imgdata.image[24 * 64 + 32];
  const double green = middle[1];
  EXPECT_GT(green, 1000);
  EXPECT_NEAR(middle[0] / green, 1.0, 0.01);
  EXPECT_NEAR(middle[2] / green, 1.0, 0.01);
}

TEST(Dng, RefusesWhatIsNoWholeRawFrame) {
  const std::vector<std::uint8_t> bytes(64 * 48);
  const RawImage grey{PixelFormat::kGrey, 64, 48, 64, 0, LumaRange::kFull, bytes};
  EXPECT_THAT(dng_of(grey, kFacts).error().sentence, HasSubstr("GREY is no raw frame"));
  BayerFrame cut = random_bayer_frame(PixelFormat::kRggb8, 64, 48, 8);
  cut.image.bytes = cut.image.bytes.first(64);
  EXPECT_THAT(dng_of(cut.image, kFacts).error().sentence, HasSubstr("cut short"));
}

}  // namespace
}  // namespace plumbline::pixels
