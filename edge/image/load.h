// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "edge/image/patch.h"

namespace plumbline::image {

// All photos with their reductions. Fails with the source's own sentence where a photo cannot be
// loaded, and where one is not grey; a photo without pixels is an empty PhotoLevels.
Result<std::vector<PhotoLevels>> load_photos(const GreyImageSource& photos, int photo_count,
                                             int threads, const Progress& progress);

}  // namespace plumbline::image
