// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "edge/base/image.h"
#include "edge/base/raw_image.h"

namespace plumbline::pixels {

// Where the red sample is among the first two rows' first two.
struct RedSite {
  int u = 0;
  int v = 0;
};
RedSite red_site(BayerOrder order);

// Row v of a Bayer frame that check_layout() accepts, in its full depth: width samples of
// 0 .. 2^bits - 1. `layout` is that of the frame's format.
void bayer_row(const RawImage& frame, const BayerLayout& layout, int v, std::uint16_t* samples);

// All samples, one channel; of more than 8 bits the upper 8.
Image bayer_samples(const RawImage& frame, const BayerLayout& layout);

// Red, green and blue at every pixel of samples of an even size, bilinear.
Image demosaic(const Image& samples, BayerOrder order);

}  // namespace plumbline::pixels
