// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline config` to the command line. When it runs it sets `status`: 0 good, 1 a file that
// cannot be read or is wrong somewhere (each fault a sentence on standard error), 2 wrong usage.
void add_config(CLI::App& app, int& status);

}  // namespace plumbline::commands
