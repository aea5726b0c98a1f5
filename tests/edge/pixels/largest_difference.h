// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "edge/base/image.h"

namespace plumbline::pixels {

// Over all channels of all pixels that are not within `border` of the edge.
inline int largest_difference(const Image& image, const cv::Mat& reference, int border = 0) {
  int largest = 0;
  for (int v = border; v < image.height_px - border; ++v) {
    for (int u = border; u < image.width_px - border; ++u) {
      for (int c = 0; c < image.channels; ++c) {
        const int ours = image.data[image.index(u, v) + static_cast<std::size_t>(c)];
        const int theirs = reference.ptr<std::uint8_t>(v)[u * image.channels + c];
        largest = std::max(largest, std::abs(ours - theirs));
      }
    }
  }
  return largest;
}

}  // namespace plumbline::pixels
