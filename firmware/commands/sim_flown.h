// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "firmware/commands/sim_folder.h"
#include "sim/profile.h"

namespace plumbline::commands {

struct FlownFlight {
  sim::Profile profile;
  std::uint64_t seed = 1;
  std::optional<Image> ground_photo;
  int threads = 1;  // of the painter
};

// A flight of the daemon in virtual time: its session against a simulated receiver, camera and
// wire, from the ground to the ground. Writes the folder as the daemon does, flight.journal
// included, with truth/ of the photos it took beside it. The same flight gives the same bytes.
// Fails where the profile has what a receiver in flight has not: no positions, a solution that is
// not fixed, a compass in the photos, or more than one side-step; and where no photo came of it.
Result<SimulatedFolder> write_flown_flight(const FlownFlight& flown,
                                           const std::filesystem::path& folder,
                                           const Progress& progress);

}  // namespace plumbline::commands
