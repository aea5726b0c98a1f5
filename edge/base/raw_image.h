// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "edge/base/result.h"

namespace plumbline {

// How a camera lays pixels out in memory. Names are those of V4L2's fourcc codes.
enum class PixelFormat {
  kGrey,         // GREY: 8 bits
  kYuyv,         // YUYV: Y0 U Y1 V
  kNv12,         // NV12: a plane of Y, then one of interleaved U V at half the size
  kMjpeg,        // MJPG: a JPEG a frame
  kRgb24,        // RGB3: red, green, blue bytes
  kRggb8,        // RGGB: Bayer, 8 bits
  kRggb10,       // RG10: Bayer, 10 bits in 16, little-endian
  kRggb10Packed  // pRAA: Bayer, four samples of 10 bits in 5 bytes (MIPI CSI-2)
};

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

// The four letters of the format's name: "GREY", "MJPG".
std::string name_of(PixelFormat format);

// The format of that name, upper or lower case; or an error that lists the names.
Result<PixelFormat> pixel_format_of(const std::string& name);

// Bytes of one row without padding; of kNv12 of either plane; 0 for kMjpeg.
std::size_t row_bytes(PixelFormat format, int width_px);

// Whether all pixels lie within the bytes. An error says what is short: a camera's frame was cut,
// or a driver claims a size that it did not fill. Of a kMjpeg only that it begins and has an end.
Status check_layout(const RawImage& image);

}  // namespace plumbline
