// SPDX-License-Identifier: MIT
#include "edge/pixels/dng.h"

#include <array>
#include <cstddef>

#include "edge/pixels/bayer.h"
#include "edge/pixels/tiff_directory.h"

namespace plumbline::pixels {
namespace {

// TIFF 6.0, TIFF/EP (ISO 12234-2) and DNG 1.4 name them so.
enum Tag : std::uint16_t {
  kNewSubfileType = 254,
  kImageWidth = 256,
  kImageLength = 257,
  kBitsPerSample = 258,
  kCompression = 259,
  kPhotometricInterpretation = 262,
  kOrientation = 274,
  kSamplesPerPixel = 277,
  kRowsPerStrip = 278,
  kPlanarConfiguration = 284,
  kSoftware = 305,
  kCfaRepeatPatternDim = 33421,
  kCfaPattern = 33422,
  kExposureTime = 33434,
  kDngVersion = 50706,
  kDngBackwardVersion = 50707,
  kUniqueCameraModel = 50708,
  kCfaPlaneColor = 50710,
  kCfaLayout = 50711,
  kBlackLevelRepeatDim = 50713,
  kBlackLevel = 50714,
  kWhiteLevel = 50717,
  kColorMatrix1 = 50721,
  kAsShotNeutral = 50728,
  kCalibrationIlluminant1 = 50778
};

constexpr std::uint16_t kColourFilterArray = 32803;
constexpr std::uint16_t kDaylight = 21;  // D65

// IEC 61966-2-1, from XYZ to linear red, green and blue.
constexpr std::array<double, 9> kRgbFromXyz = {3.2406, -1.5372, -0.4986, -0.9689, 1.8758,
                                               0.0415, 0.0557,  -0.2040, 1.0570};

// Index into RawColour::black of the sample at (u, v).
std::size_t site_at(RedSite red, int u, int v) {
  return (u == red.u ? 0u : 1u) + (v == red.v ? 0u : 2u);
}

void describe_picture(const RawImage& frame, const BayerLayout& layout, TiffDirectory& tags) {
  tags.set_longs(kNewSubfileType, {0});
  tags.set_longs(kImageWidth, {static_cast<std::uint32_t>(frame.width_px)});
  tags.set_longs(kImageLength, {static_cast<std::uint32_t>(frame.height_px)});
  tags.set_longs(kRowsPerStrip, {static_cast<std::uint32_t>(frame.height_px)});
  tags.set_shorts(kBitsPerSample, {static_cast<std::uint16_t>(layout.bits == 8 ? 8 : 16)});
  tags.set_shorts(kCompression, {1});
  tags.set_shorts(kPhotometricInterpretation, {kColourFilterArray});
  tags.set_shorts(kOrientation, {1});
  tags.set_shorts(kSamplesPerPixel, {1});
  tags.set_shorts(kPlanarConfiguration, {1});
}

void describe_samples(const BayerLayout& layout, const RawColour& colour, TiffDirectory& tags) {
  constexpr std::array<std::uint8_t, 4> kColourOfSite = {0, 1, 1, 2};
  const RedSite red = red_site(layout.order);
  const double full_scale = 1 << layout.bits;
  std::vector<std::uint8_t> pattern;
  std::vector<double> black;
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 2; ++u) {
      const std::size_t site = site_at(red, u, v);
      pattern.push_back(kColourOfSite[site]);
      black.push_back(colour.black ? (*colour.black)[site] * full_scale : 0.0);
    }
  }
  tags.set_shorts(kCfaRepeatPatternDim, {2, 2});
  tags.set_bytes(kCfaPattern, pattern);
  tags.set_bytes(kCfaPlaneColor, {0, 1, 2});
  tags.set_shorts(kCfaLayout, {1});
  tags.set_shorts(kBlackLevelRepeatDim, {2, 2});
  tags.set_ratios(kBlackLevel, black);
  tags.set_longs(kWhiteLevel, {(1u << layout.bits) - 1});
}

// DNG 1.4, chapter 6: ColorMatrix1 leads from XYZ to the sensor's own red, green and blue, of which
// AsShotNeutral is what a grey surface has.
void describe_colours(const RawColour& colour, TiffDirectory& tags) {
  const std::array<double, 2> gains = colour.gains.value_or(std::array<double, 2>{1, 1});
  const std::array<double, 3> neutral = {1 / gains[0], 1, 1 / gains[1]};
  std::vector<double> matrix(kRgbFromXyz.begin(), kRgbFromXyz.end());
  for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i] *= neutral[i / 3];
  tags.set_signed_ratios(kColorMatrix1, matrix);
  tags.set_ratios(kAsShotNeutral, {neutral.begin(), neutral.end()});
  tags.set_shorts(kCalibrationIlluminant1, {kDaylight});
}

std::vector<std::uint8_t> strip_of(const RawImage& frame, const BayerLayout& layout) {
  const auto width = static_cast<std::size_t>(frame.width_px);
  std::vector<std::uint16_t> row(width);
  std::vector<std::uint8_t> strip;
  strip.reserve(width * static_cast<std::size_t>(frame.height_px) * (layout.bits == 8 ? 1 : 2));
  for (int v = 0; v < frame.height_px; ++v) {
    bayer_row(frame, layout, v, row.data());
    for (const std::uint16_t sample : row) {
      strip.push_back(static_cast<std::uint8_t>(sample));
      if (layout.bits > 8) strip.push_back(static_cast<std::uint8_t>(sample >> 8));
    }
  }
  return strip;
}

}  // namespace

Result<std::vector<std::uint8_t>> dng_of(const RawImage& frame, const DngFacts& facts) {
  if (const Status layout = check_layout(frame); !layout) return layout.error();
  const std::optional<BayerLayout> layout = bayer_of(frame.format);
  if (!layout) {
    return Error{"A camera frame of " + name_of(frame.format) +
                 " is no raw frame: ask the camera for a Bayer format, as SRGGB10."};
  }
  TiffDirectory tags;
  describe_picture(frame, *layout, tags);
  describe_samples(*layout, facts.colour, tags);
  describe_colours(facts.colour, tags);
  tags.set_text(kSoftware, "Plumbline");
  tags.set_text(kUniqueCameraModel, facts.camera);
  tags.set_bytes(kDngVersion, {1, 4, 0, 0});
  tags.set_bytes(kDngBackwardVersion, {1, 1, 0, 0});
  if (facts.exposure) {
    tags.set_ratios(kExposureTime, {std::chrono::duration<double>(*facts.exposure).count()});
  }
  return tags.file_with(strip_of(frame, *layout));
}

}  // namespace plumbline::pixels
