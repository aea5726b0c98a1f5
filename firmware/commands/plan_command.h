// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline plan` to the command line. When it runs it sets `status`: 0 good (the goal
// reached or not), 1 a camera that cannot be read or a flight that determines nothing, 2 wrong
// usage. Writes no file.
void add_plan(CLI::App& app, int& status);

}  // namespace plumbline::commands
