// SPDX-License-Identifier: MIT
#include "edge/pixels/bayer.h"

#include <cstdint>

namespace plumbline::pixels {
namespace {

// 10 bits in 16, little-endian: the upper 8 are bits 2 to 9.
void row_of_10(const std::uint8_t* from, int width, std::uint8_t* to) {
  for (int u = 0; u < width; ++u) {
    to[u] = static_cast<std::uint8_t>(((from[2 * u + 1] & 3) << 6) | (from[2 * u] >> 2));
  }
}

// Four samples' upper 8 bits, then a byte with the four's lower 2.
void row_of_packed_10(const std::uint8_t* from, int width, std::uint8_t* to) {
  for (int u = 0; u < width; ++u) to[u] = from[u / 4 * 5 + u % 4];
}

void row_of_8(const std::uint8_t* from, int width, std::uint8_t* to) {
  for (int u = 0; u < width; ++u) to[u] = from[u];
}

// Three rows around row v, mirrored at the border about the pixel there, which keeps the pattern.
struct Rows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
};

Rows rows_around(const Image& samples, int v) {
  const int above = v > 0 ? v - 1 : 1;
  const int below = v + 1 < samples.height_px ? v + 1 : v - 1;
  const std::uint8_t* data = samples.data.data();
  return {data + samples.index(0, above), data + samples.index(0, v),
          data + samples.index(0, below)};
}

std::uint8_t mean(int a, int b) { return static_cast<std::uint8_t>((a + b + 1) >> 1); }

std::uint8_t mean(int a, int b, int c, int d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) >> 2);
}

// At a red or a blue sample: green from the cross, the opposite colour from the corners.
void at_colour(const Rows& r, int left, int u, int right, std::uint8_t* own, std::uint8_t* green,
               std::uint8_t* opposite) {
  *own = r.here[u];
  *green = mean(r.above[u], r.below[u], r.here[left], r.here[right]);
  *opposite = mean(r.above[left], r.above[right], r.below[left], r.below[right]);
}

// At a green one: the row's colour from left and right, the other from above and below.
void at_green(const Rows& r, int left, int u, int right, std::uint8_t* row_colour,
              std::uint8_t* green, std::uint8_t* other) {
  *green = r.here[u];
  *row_colour = mean(r.here[left], r.here[right]);
  *other = mean(r.above[u], r.below[u]);
}

void demosaic_row(const Rows& rows, int width, bool red_row, std::uint8_t* rgb) {
  for (int u = 0; u < width; ++u, rgb += 3) {
    const int left = u > 0 ? u - 1 : 1;
    const int right = u + 1 < width ? u + 1 : u - 1;
    std::uint8_t* row_colour = red_row ? rgb : rgb + 2;
    std::uint8_t* other = red_row ? rgb + 2 : rgb;
    const bool green = (u % 2 == 0) != red_row;
    if (green) {
      at_green(rows, left, u, right, row_colour, rgb + 1, other);
    } else {
      at_colour(rows, left, u, right, row_colour, rgb + 1, other);
    }
  }
}

}  // namespace

Image bayer_samples(const RawImage& frame) {
  Image samples{frame.width_px, frame.height_px, 1, {}};
  samples.data.resize(static_cast<std::size_t>(frame.width_px) *
                      static_cast<std::size_t>(frame.height_px));
  const auto read_row = frame.format == PixelFormat::kRggb10         ? row_of_10
                        : frame.format == PixelFormat::kRggb10Packed ? row_of_packed_10
                                                                     : row_of_8;
  for (int v = 0; v < frame.height_px; ++v) {
    const std::uint8_t* row = frame.bytes.data() + static_cast<std::size_t>(v) * frame.stride_bytes;
    read_row(row, frame.width_px, samples.data.data() + samples.index(0, v));
  }
  return samples;
}

Image demosaic(const Image& samples) {
  Image rgb{samples.width_px, samples.height_px, 3, {}};
  rgb.data.resize(3 * samples.data.size());
  for (int v = 0; v < samples.height_px; ++v) {
    demosaic_row(rows_around(samples, v), samples.width_px, v % 2 == 0,
                 rgb.data.data() + rgb.index(0, v));
  }
  return rgb;
}

}  // namespace plumbline::pixels
