// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline replay FLIGHT`: the daemon's own code over a recording.
void add_replay(CLI::App& app, int& status);

}  // namespace plumbline::commands
