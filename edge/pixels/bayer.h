// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/image.h"
#include "edge/base/raw_image.h"

namespace plumbline::pixels {

// The samples of a Bayer frame that check_layout() accepts, one channel, 8 bits.
Image bayer_samples(const RawImage& frame);

// Red, green and blue at every pixel of RGGB samples of an even size, bilinear.
Image demosaic(const Image& samples);

}  // namespace plumbline::pixels
