// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "edge/base/result.h"

namespace plumbline {

// How a camera lays pixels out in memory. Names are those of V4L2's fourcc codes.
enum class PixelFormat {
  kGrey,   // GREY: 8 bits
  kYuyv,   // YUYV: Y0 U Y1 V
  kNv12,   // NV12: a plane of Y, then one of interleaved U V at half the size
  kMjpeg,  // MJPG: a JPEG a frame
  kRgb24,  // RGB3: red, green, blue bytes
  // Bayer: one colour a sample, in the order of the first two rows' first two. See bayer_of().
  kRggb8,  // RGGB
  kGrbg8,  // GRBG
  kGbrg8,  // GBRG
  kBggr8,  // BA81
  // 10 bits in 16, little-endian.
  kRggb10,  // RG10
  kGrbg10,  // BA10
  kGbrg10,  // GB10
  kBggr10,  // BG10
  // MIPI CSI-2: four samples of 10 bits in 5 bytes.
  kRggb10Packed,  // pRAA
  kGrbg10Packed,  // pgAA
  kGbrg10Packed,  // pGAA
  kBggr10Packed,  // pBAA
  // 12 bits in 16, little-endian.
  kRggb12,  // RG12
  kGrbg12,  // BA12
  kGbrg12,  // GB12
  kBggr12,  // BG12
  // MIPI CSI-2: two samples of 12 bits in 3 bytes.
  kRggb12Packed,  // pRCC
  kGrbg12Packed,  // pgCC
  kGbrg12Packed,  // pGCC
  kBggr12Packed,  // pBCC
  // 16 bits, little-endian.
  kRggb16,  // RG16
  kGrbg16,  // GR16
  kGbrg16,  // GB16
  kBggr16   // BYR2
};

// The colours of a Bayer pattern's first row, then of its second.
enum class BayerOrder { kRggb, kGrbg, kGbrg, kBggr };

struct BayerLayout {
  BayerOrder order = BayerOrder::kRggb;
  int bits = 8;         // of a sample: 8, 10, 12 or 16
  bool packed = false;  // samples share bytes, as MIPI CSI-2 sends them
};

// How a Bayer format lies in memory; nullopt of all others.
std::optional<BayerLayout> bayer_of(PixelFormat format);

// The four letters of the format's name, as V4L2 writes them: "GREY", "MJPG", "pgAA".
std::string name_of(PixelFormat format);

// The same as a number, the first letter lowest: a V4L2 fourcc.
std::uint32_t code_of(PixelFormat format);
std::optional<PixelFormat> pixel_format_of_code(std::uint32_t code);

// The format of that name: V4L2's letters, or for Bayer also its long form ("SRGGB10", packed
// "SRGGB10P"). Upper or lower case, where that leaves only one (pGAA and pgAA are two). An error
// lists the names.
Result<PixelFormat> pixel_format_of(const std::string& name);

// All names for a person, in one line.
std::string pixel_format_names();

// Bytes of one row without padding; of kNv12 of either plane; 0 for kMjpeg.
std::size_t row_bytes(PixelFormat format, int width_px);

}  // namespace plumbline
