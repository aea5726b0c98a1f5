// SPDX-License-Identifier: MIT
#include "edge/pixels/bayer.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plumbline::pixels {
namespace {

// Bits above those of a sample are noise to some sensors' receivers.
void unpack_16(const std::uint8_t* from, int width, int bits, std::uint16_t* to) {
  const int mask = (1 << bits) - 1;
  for (int u = 0; u < width; ++u) {
    to[u] = static_cast<std::uint16_t>((from[2 * u] | from[2 * u + 1] << 8) & mask);
  }
}

// MIPI CSI-2, RAW10: four samples' upper 8 bits, then a byte with the four's lower 2, the first's
// lowest.
void unpack_packed_10(const std::uint8_t* from, int width, std::uint16_t* to) {
  for (int u = 0; u < width; ++u) {
    const std::uint8_t* four = from + u / 4 * 5;
    const int low = four[4] >> (2 * (u % 4)) & 3;
    to[u] = static_cast<std::uint16_t>(four[u % 4] << 2 | low);
  }
}

// MIPI CSI-2, RAW12: two samples' upper 8 bits, then a byte with the two's lower 4, the first's
// lowest.
void unpack_packed_12(const std::uint8_t* from, int width, std::uint16_t* to) {
  for (int u = 0; u < width; ++u) {
    const std::uint8_t* two = from + u / 2 * 3;
    const int low = two[2] >> (4 * (u % 2)) & 15;
    to[u] = static_cast<std::uint16_t>(two[u % 2] << 4 | low);
  }
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

// Where a row's greens are, and whether its other colour is red.
struct RowPattern {
  bool red = false;
  int first_green = 0;  // 0 or 1
};

RowPattern pattern_of_row(BayerOrder order, int v) {
  const RedSite red = red_site(order);
  return {v % 2 == red.v, (v + red.u + red.v + 1) % 2};
}

void demosaic_row(const Rows& rows, int width, RowPattern pattern, std::uint8_t* rgb) {
  for (int u = 0; u < width; ++u, rgb += 3) {
    const int left = u > 0 ? u - 1 : 1;
    const int right = u + 1 < width ? u + 1 : u - 1;
    std::uint8_t* row_colour = pattern.red ? rgb : rgb + 2;
    std::uint8_t* other = pattern.red ? rgb + 2 : rgb;
    if (u % 2 == pattern.first_green) {
      at_green(rows, left, u, right, row_colour, rgb + 1, other);
    } else {
      at_colour(rows, left, u, right, row_colour, rgb + 1, other);
    }
  }
}

}  // namespace

RedSite red_site(BayerOrder order) {
  const bool right = order == BayerOrder::kGrbg || order == BayerOrder::kBggr;
  const bool below = order == BayerOrder::kGbrg || order == BayerOrder::kBggr;
  return {right ? 1 : 0, below ? 1 : 0};
}

void bayer_row(const RawImage& frame, const BayerLayout& layout, int v, std::uint16_t* samples) {
  const std::uint8_t* row = frame.bytes.data() + static_cast<std::size_t>(v) * frame.stride_bytes;
  if (layout.bits == 8) {
    std::copy_n(row, frame.width_px, samples);
  } else if (!layout.packed) {
    unpack_16(row, frame.width_px, layout.bits, samples);
  } else if (layout.bits == 10) {
    unpack_packed_10(row, frame.width_px, samples);
  } else {
    unpack_packed_12(row, frame.width_px, samples);
  }
}

Image bayer_samples(const RawImage& frame, const BayerLayout& layout) {
  Image samples{frame.width_px, frame.height_px, 1, {}};
  samples.data.resize(static_cast<std::size_t>(frame.width_px) *
                      static_cast<std::size_t>(frame.height_px));
  std::vector<std::uint16_t> row(static_cast<std::size_t>(frame.width_px));
  std::uint8_t* to = samples.data.data();
  for (int v = 0; v < frame.height_px; ++v) {
    bayer_row(frame, layout, v, row.data());
    for (const std::uint16_t sample : row) {
      *to++ = static_cast<std::uint8_t>(sample >> (layout.bits - 8));
    }
  }
  return samples;
}

Image demosaic(const Image& samples, BayerOrder order) {
  Image rgb{samples.width_px, samples.height_px, 3, {}};
  rgb.data.resize(3 * samples.data.size());
  for (int v = 0; v < samples.height_px; ++v) {
    demosaic_row(rows_around(samples, v), samples.width_px, pattern_of_row(order, v),
                 rgb.data.data() + rgb.index(0, v));
  }
  return rgb;
}

}  // namespace plumbline::pixels
