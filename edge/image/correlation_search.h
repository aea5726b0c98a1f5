// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/image/patch.h"

namespace plumbline::image {

struct SearchOptions {
  int half_size = 8;               // of the template, in steps
  double least_correlation = 0.6;  // of the best place at every resolution
  double most_second = 0.95;       // second-best place apart from it, as a share of the best
};

// Moves `guess.target_px` to the place within `radius_px` (target pixels) where the target, read
// in the reference's geometry, correlates best with the reference's surroundings: from coarse steps
// to fine. Good to about a pixel of the coarser photo. Nothing where no place, or more than one
// place, is convincing.
std::optional<LocalMap> search_by_correlation(const PhotoLevels& reference,
                                              const PhotoLevels& target, const LocalMap& guess,
                                              double radius_px, const SearchOptions& options);

}  // namespace plumbline::image
