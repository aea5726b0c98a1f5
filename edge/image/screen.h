// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "edge/image/homography.h"
#include "edge/image/tie_points.h"

namespace plumbline::image {

// Two overlapping photos as the screening sees them, in full-resolution pixels.
struct ScreenedPair {
  PhotoPair pair;
  // Matches good to a few pixels, those off the homography (relief) included.
  std::vector<Correspondence> matches;
};

// Compares all pairs of photos at reduced size (SIFT, Lowe 2004; ratio test, mutual best) and keeps
// those that overlap, sorted by (first, second). A photo without texture is in no pair.
std::vector<ScreenedPair> screen_pairs(const std::vector<PhotoLevels>& photos,
                                       const TieOptions& options,
                                       const std::function<void(int done, int total)>& progress);

}  // namespace plumbline::image
