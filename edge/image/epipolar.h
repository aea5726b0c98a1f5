// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "edge/image/homography.h"

namespace plumbline::image {

// Which matches of two photos of a rigid scene lie off their epipolar line by more than their
// neighbours do (true = suspect). Nothing is assumed of the relief; lens distortion, which bends
// the lines smoothly, is taken out by the neighbours. The fundamental matrix comes from a seeded
// random sample consensus over the normalised eight-point algorithm (Hartley and Zisserman 2004,
// algorithm 11.1). `pixel_px`: a pixel of the coarser photo, in second-photo pixels. Fewer than 20
// matches are not judged.
std::vector<bool> off_epipolar_line(const std::vector<Correspondence>& matches, double pixel_px,
                                    std::uint64_t seed);

}  // namespace plumbline::image
