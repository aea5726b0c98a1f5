// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline camera [list|shot]`: the cameras of this machine with their modes and controls;
// or one photo as a JPEG file. When the command ran, `status` is its exit status.
void add_camera(CLI::App& app, int& status);

}  // namespace plumbline::commands
