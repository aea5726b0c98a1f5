// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/image/tie_points.h"

namespace plumbline::ingest {

// The tie points of an earlier result: of its observations.csv every point but those of
// `named_now`, used or not. TieObservation::photo is the index in `photo_names`; the covariance is
// that of the table's sigma. Pairs and components are not in the table, and stay empty. Fails, with
// "file:line: sentence", on a photo that is not among them, and where nothing is left.
Result<image::TiePoints> read_ties(const std::filesystem::path& path,
                                   const std::vector<std::string>& photo_names,
                                   const std::set<std::string>& named_now);

}  // namespace plumbline::ingest
