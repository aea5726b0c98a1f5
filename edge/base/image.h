// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "edge/base/result.h"

namespace plumbline {

// An 8-bit image, rows top down, channels interleaved (1 = grey, 3 = red green blue), no padding.
// Pixel (u, v) = (0, 0) is the CENTRE of the top-left pixel.
struct Image {
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::vector<std::uint8_t> data;  // width_px * height_px * channels bytes

  bool empty() const { return data.empty(); }
  std::size_t index(int u, int v) const {
    return (static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) +
            static_cast<std::size_t>(u)) *
           static_cast<std::size_t>(channels);
  }
};

// Loads photo `photo` (0-based) as grey. May be called from several threads at once.
using GreyImageSource = std::function<Result<Image>(int photo)>;

}  // namespace plumbline
