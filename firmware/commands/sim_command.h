// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline sim` to the command line. When it runs it sets `status`: 0 good, 1 the work
// failed. The flight's folder is new or empty; a failure leaves nothing behind.
void add_sim(CLI::App& app, int& status);

}  // namespace plumbline::commands
