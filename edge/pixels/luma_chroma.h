// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "edge/base/raw_image.h"

namespace plumbline::pixels {

// Reads rows of a YUYV or NV12 frame that check_layout() accepts, in full range.
class LumaChroma {
 public:
  explicit LumaChroma(const RawImage& frame);

  void luma_row(int v, std::uint8_t* grey) const;  // width bytes
  void ycbcr_row(int v, std::uint8_t* out) const;  // 3 * width: Y Cb Cr of each pixel
  void rgb_row(int v, std::uint8_t* rgb) const;    // 3 * width: red green blue of each pixel

 private:
  const std::uint8_t* luma_at(int v) const;
  const std::uint8_t* chroma_at(int v) const;  // of the pair of pixels 0 and 1

  const RawImage& frame_;
  int luma_step_;    // from one Y to the next
  int chroma_step_;  // from one pair's Cb to the next pair's
  int cr_offset_;    // from Cb to Cr
  std::array<std::uint8_t, 256> luma_{};
  std::array<std::uint8_t, 256> chroma_{};
};

}  // namespace plumbline::pixels
