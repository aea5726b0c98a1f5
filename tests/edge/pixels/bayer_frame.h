// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "edge/base/raw_image.h"

namespace plumbline::pixels {

inline std::vector<PixelFormat> all_bayer_formats() {
  std::vector<PixelFormat> formats;
  const int last = static_cast<int>(PixelFormat::kBggr16);
  for (int i = static_cast<int>(PixelFormat::kRggb8); i <= last; ++i) {
    formats.push_back(static_cast<PixelFormat>(i));
  }
  return formats;
}

// A Bayer frame of known samples, written as the format's own document has it: V4L2's pages of
// SRGGB10, SRGGB10P and so on. Rows are padded with noise.
struct BayerFrame {
  std::vector<std::uint16_t> samples;
  std::vector<std::uint8_t> bytes;
  RawImage image;

  BayerFrame(PixelFormat format, int width, int height, std::vector<std::uint16_t> of_samples,
             std::size_t padding = 3)
      : samples(std::move(of_samples)) {
    const BayerLayout layout = bayer_of(format).value();
    const auto columns = static_cast<std::size_t>(width);
    std::mt19937 noise(1);
    for (std::size_t first = 0; first < samples.size(); first += columns) {
      const std::size_t row = bytes.size();
      put_row(layout, &samples[first], columns);
      bytes.resize(row + row_bytes(format, width), 0);
      for (std::size_t i = 0; i < padding; ++i) put(static_cast<unsigned>(noise()));
    }
    const std::size_t stride = row_bytes(format, width) + padding;
    image = {format, width, height, stride, 0, LumaRange::kFull, bytes};
  }

 private:
  void put(unsigned value) { bytes.push_back(static_cast<std::uint8_t>(value)); }

  void put_row(const BayerLayout& layout, const std::uint16_t* sample, std::size_t count) {
    for (std::size_t u = 0; u < count;) {
      if (layout.packed && layout.bits == 10) {
        u += put_packed_10(sample + u, std::min<std::size_t>(4, count - u));
      } else if (layout.packed) {
        for (const std::size_t i : {u, u + 1}) put(sample[i] >> 4u);
        put((sample[u] & 15u) | (sample[u + 1] & 15u) << 4u);
        u += 2;
      } else {
        put(sample[u]);
        if (layout.bits > 8) put(sample[u] >> 8u);
        ++u;
      }
    }
  }

  std::size_t put_packed_10(const std::uint16_t* sample, std::size_t count) {
    unsigned low = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      put(i < count ? sample[i] >> 2u : 0);
      if (i < count) low |= (sample[i] & 3u) << (2 * i);
    }
    put(low);
    return count;
  }
};

// Samples of any value that the format can hold.
inline BayerFrame random_bayer_frame(PixelFormat format, int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  const unsigned largest = (1u << bayer_of(format).value().bits) - 1;
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(width * height));
  for (std::uint16_t& sample : samples) sample = static_cast<std::uint16_t>(random() & largest);
  return {format, width, height, std::move(samples)};
}

}  // namespace plumbline::pixels
