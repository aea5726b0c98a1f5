// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/base/result.h"
#include "edge/orient/network/network.h"
#include "edge/orient/problem.h"

namespace plumbline::orient {

// A first network from the image coordinates alone, for photos that look down on ground that is
// flat compared with the flying height.
struct FreeStart {
  std::vector<int> photo_of_slot;  // the photos that hang together; others are left out
  // Ground plane z = 0; the reference photo stands at (0, 0, kReferenceHeight) with kappa 0.
  State state;
};
inline constexpr double kReferenceHeight = 100.0;

// Each pair of photos is a similarity of the plane (scale, rotation, shift), found among
// mismatches by sampling (RANSAC, Fischler and Bolles 1981, with a fixed seed); a spanning tree of
// the pairs with most matches gives height, azimuth and foot of each photo; each point is the
// median of its rays' intersections with the plane. Fails where no two photos hang together.
Result<FreeStart> free_start(const Problem& problem);

}  // namespace plumbline::orient
