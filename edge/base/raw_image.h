// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "edge/base/pixel_format.h"
#include "edge/base/result.h"

namespace plumbline {

// How kYuyv and kNv12 write black and white: always by BT.601's matrix, in one of two ranges.
enum class LumaRange {
  kFull,    // 0 and 255, as in JPEG files
  kLimited  // Y 16 and 235, colour 16 to 240: what Linux takes video to be unless told otherwise
};

// Pixels as a camera left them in its buffer.
struct RawImage {
  PixelFormat format = PixelFormat::kGrey;
  int width_px = 0;
  int height_px = 0;
  std::size_t stride_bytes = 0;         // from one row to the next; 0 for kMjpeg
  std::size_t second_plane_offset = 0;  // kNv12: where U V begin; their stride is that of Y
  LumaRange range = LumaRange::kFull;   // kYuyv, kNv12
  std::span<const std::uint8_t> bytes;  // of all planes; valid as long as the frame is held
};

// What a driver knows of the colours of a Bayer frame.
struct RawColour {
  // What a sample is without light, as a share of 2^bits: of red, of green in red's rows, of green
  // in blue's rows, of blue.
  std::optional<std::array<double, 4>> black;
  // By which red and blue are multiplied so that what is grey has as much of them as of green; > 0.
  std::optional<std::array<double, 2>> gains;
};

// Whether all pixels lie within the bytes. An error says what is short: a camera's frame was cut,
// or a driver claims a size that it did not fill. Of a kMjpeg only that it begins and has an end.
Status check_layout(const RawImage& image);

}  // namespace plumbline
