// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "firmware/commands/sim_folder.h"
#include "sim/flight.h"

namespace plumbline::commands {

// Flies and writes the folder: photos/0001.jpg ..., camera.toml as calibrated, and truth/ with
// camera.toml, photos.csv, picks.csv, check.csv and surface.asc. `folder` must be absent or an
// empty directory; after a failure it is as it was.
Result<SimulatedFolder> write_simulated_flight(const sim::Flight& flight,
                                               const std::optional<Image>& ground_photo,
                                               const std::filesystem::path& folder, int threads,
                                               const Progress& progress);

}  // namespace plumbline::commands
