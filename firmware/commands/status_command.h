// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline status [--watch]`: what the daemon is doing.
void add_status(CLI::App& app, int& status);

}  // namespace plumbline::commands
