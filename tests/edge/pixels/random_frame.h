// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "edge/base/raw_image.h"

namespace plumbline::pixels {

// A frame of noise with rows padded to a stride, as cameras like to have it.
struct RandomFrame {
  std::vector<std::uint8_t> bytes;
  RawImage image;

  RandomFrame(PixelFormat format, int width, int height, std::size_t padding, unsigned seed) {
    const std::size_t stride = row_bytes(format, width) + padding;
    const auto rows = static_cast<std::size_t>(height);
    const bool two_planes = format == PixelFormat::kNv12;
    std::mt19937 random(seed);
    bytes.resize(stride * (two_planes ? rows + rows / 2 : rows));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    image = {format,           width, height, stride, two_planes ? stride * rows : 0,
             LumaRange::kFull, bytes};
  }
};

}  // namespace plumbline::pixels
