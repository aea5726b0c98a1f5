// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "edge/base/image.h"

namespace plumbline::sim {

// Square paintings of ground, row by row.
struct Painting {
  int side = 0;
  std::vector<std::uint8_t> texels;
};

// Soil and grass with stones, tufts and wheel tracks, 4 bytes a texel (red, green, blue, 0), at
// least `side` texels wide, `texel_m` each.
Painting paint_ground(int side, double texel_m, std::uint64_t seed, int threads);

// What is finer than that: grains, pebbles and blades on a texel of a centimetre, one byte a
// texel, 128 = unchanged; it continues at the opposite edge. The side is a power of two.
Painting paint_detail(std::uint64_t seed, int threads);

}  // namespace plumbline::sim
