// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "edge/base/result.h"
#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// Writes summary.json, points.csv, photos.csv, camera.toml, observations.csv, check.csv (with a
// check), report.html and timing.json into `folder`, all or nothing: they are written beside it
// first and moved in when all are whole. Files of these names from an earlier run are replaced,
// others in the folder are left alone. A full disk leaves what was there before.
Status write(const Product& product, const Timing& timing, const std::filesystem::path& folder);

}  // namespace plumbline::deliver
