// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline measure PHOTOS... | FLIGHT`: from photos to measured ground.
void add_measure(CLI::App& app, int& status);

}  // namespace plumbline::commands
