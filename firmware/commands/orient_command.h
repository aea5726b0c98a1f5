// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline orient CASE`: the adjustment from measured image coordinates, without images.
void add_orient(CLI::App& app, int& status);

}  // namespace plumbline::commands
