// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "edge/base/result.h"
#include "edge/geodesy/local_frame.h"
#include "sim/flight.h"
#include "sim/world.h"

namespace plumbline::commands {

struct SimulatedFolder {
  int photos = 0;
  int targets = 0;
};

// Makes `folder`, which must be absent or an empty directory, with photos/ and truth/ in it, for
// `fill` to write into; after a failure it is as it was.
Result<SimulatedFolder> in_new_folder(const std::filesystem::path& folder,
                                      const std::function<Result<SimulatedFolder>()>& fill);

// camera.toml as calibrated, and truth/ with camera.toml, photos.csv, picks.csv, check.csv and
// surface.asc.
Status write_truth(const sim::World& world, const sim::Flight& flight,
                   const geodesy::LocalFrame& frame, const std::filesystem::path& folder);

}  // namespace plumbline::commands
