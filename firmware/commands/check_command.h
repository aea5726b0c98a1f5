// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline check FLIGHT`: is the recording complete, truncated or damaged; what is in it.
void add_check(CLI::App& app, int& status);

}  // namespace plumbline::commands
