// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "edge/image/features.h"
#include "edge/image/homography.h"
#include "edge/image/tie_points.h"

namespace plumbline::image {

// Two overlapping photos as the screening sees them, in full-resolution pixels.
struct ScreenedPair {
  PhotoPair pair;
  // Matches good to a few pixels, those off the homography (relief) included.
  std::vector<Correspondence> matches;
};

// The pairs of a growing series of photos. What one pair is found to be does not depend on when it
// was compared.
class Screening {
 public:
  // Compares all photos beyond those of the calls before with each other and with all before, at
  // reduced size (SIFT, Lowe 2004; ratio test, mutual best). A photo without texture is in no pair.
  void add(const std::vector<PhotoLevels>& photos, const TieOptions& options,
           const std::function<void(int done, int total)>& progress);

  // Those that overlap, sorted by (first, second).
  const std::vector<ScreenedPair>& pairs() const { return pairs_; }

 private:
  std::vector<Features> features_;
  std::vector<ScreenedPair> pairs_;
};

}  // namespace plumbline::image
