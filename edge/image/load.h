// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "edge/image/patch.h"

namespace plumbline::image {

// Adds to `loaded`, which holds the first of them already, all photos up to `photo_count`, with
// their reductions. Fails with the source's own sentence where a photo cannot be loaded, and where
// one is not grey, and adds none; a photo without pixels is an empty PhotoLevels.
Status load_photos(const GreyImageSource& photos, int photo_count, int threads,
                   const Progress& progress, std::vector<PhotoLevels>& loaded);

}  // namespace plumbline::image
