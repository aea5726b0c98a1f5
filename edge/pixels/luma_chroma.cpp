// SPDX-License-Identifier: MIT
#include "edge/pixels/luma_chroma.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumbline::pixels {
namespace {

std::uint8_t clipped(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

std::uint8_t clipped(int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); }

// ITU-R BT.601 section 2.5.3: 219 steps of Y above 16, 224 of colour about 128.
std::array<std::uint8_t, 256> luma_table(LumaRange range) {
  std::array<std::uint8_t, 256> table{};
  for (int y = 0; y < 256; ++y) {
    const double full = range == LumaRange::kFull ? y : (y - 16) * 255.0 / 219.0;
    table[static_cast<std::size_t>(y)] = clipped(full);
  }
  return table;
}

std::array<std::uint8_t, 256> chroma_table(LumaRange range) {
  std::array<std::uint8_t, 256> table{};
  for (int c = 0; c < 256; ++c) {
    const double full = range == LumaRange::kFull ? c : 128 + (c - 128) * 255.0 / 224.0;
    table[static_cast<std::size_t>(c)] = clipped(full);
  }
  return table;
}

// JFIF 1.02, "Conversion to and from RGB", in 1/65536.
void to_rgb(const std::uint8_t* ycbcr, std::uint8_t* rgb) {
  constexpr int kHalf = 1 << 15;
  const int y = ycbcr[0] * 65536 + kHalf;
  const int cb = ycbcr[1] - 128;
  const int cr = ycbcr[2] - 128;
  rgb[0] = clipped((y + 91881 * cr) >> 16);
  rgb[1] = clipped((y - 22554 * cb - 46802 * cr) >> 16);
  rgb[2] = clipped((y + 116130 * cb) >> 16);
}

}  // namespace

LumaChroma::LumaChroma(const RawImage& frame)
    : frame_(frame),
      luma_step_(frame.format == PixelFormat::kYuyv ? 2 : 1),
      chroma_step_(frame.format == PixelFormat::kYuyv ? 4 : 2),
      cr_offset_(frame.format == PixelFormat::kYuyv ? 2 : 1),
      luma_(luma_table(frame.range)),
      chroma_(chroma_table(frame.range)) {}

const std::uint8_t* LumaChroma::luma_at(int v) const {
  return frame_.bytes.data() + static_cast<std::size_t>(v) * frame_.stride_bytes;
}

const std::uint8_t* LumaChroma::chroma_at(int v) const {
  if (frame_.format == PixelFormat::kYuyv) return luma_at(v) + 1;
  return frame_.bytes.data() + frame_.second_plane_offset +
         static_cast<std::size_t>(v / 2) * frame_.stride_bytes;
}

void LumaChroma::luma_row(int v, std::uint8_t* grey) const {
  const std::uint8_t* y = luma_at(v);
  for (int u = 0; u < frame_.width_px; ++u, y += luma_step_) grey[u] = luma_[*y];
}

void LumaChroma::ycbcr_row(int v, std::uint8_t* out) const {
  const std::uint8_t* y = luma_at(v);
  const std::uint8_t* cb = chroma_at(v);
  for (int u = 0; u < frame_.width_px; ++u, y += luma_step_, out += 3) {
    out[0] = luma_[*y];
    out[1] = chroma_[*cb];
    out[2] = chroma_[cb[cr_offset_]];
    if (u % 2 == 1) cb += chroma_step_;
  }
}

void LumaChroma::rgb_row(int v, std::uint8_t* rgb) const {
  ycbcr_row(v, rgb);
  for (int u = 0; u < frame_.width_px; ++u, rgb += 3) {
    const std::uint8_t ycbcr[3] = {rgb[0], rgb[1], rgb[2]};
    to_rgb(ycbcr, rgb);
  }
}

}  // namespace plumbline::pixels
