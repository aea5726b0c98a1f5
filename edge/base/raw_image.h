// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

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

// Pixels as a camera left them in its buffer.
struct RawImage {
  PixelFormat format = PixelFormat::kGrey;
  int width_px = 0;
  int height_px = 0;
  std::size_t stride_bytes = 0;         // from one row to the next; 0 for kMjpeg
  std::size_t second_plane_offset = 0;  // kNv12: where U V begin
  std::span<const std::uint8_t> bytes;  // of all planes; valid as long as the frame is held
};

}  // namespace plumbline
