// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "sim/bench_flight.h"

namespace plumbline::hil {

// When each photo of a recording was taken, in seconds of the flight, as its own mark says
// (exposure_mark.h). `begun_ns`: the flight's time 0 by the clock of the marks. Fails, with the
// photo, where a mark cannot be read.
Result<std::vector<sim::BenchFlight::Taken>> read_marks(const std::filesystem::path& photos,
                                                        std::int64_t begun_ns);

// truth/ in the folder of the recording, as plumbline sim writes it.
Status write_truth(const sim::BenchFlight& flight,
                   const std::vector<sim::BenchFlight::Taken>& taken,
                   const std::filesystem::path& recording);

}  // namespace plumbline::hil
