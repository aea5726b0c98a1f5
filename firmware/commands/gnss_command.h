// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Adds `plumbline gnss [PORT|FILE|-] [--baud N] [--json]`: what a receiver says, one line per
// position epoch and the counters last; without a source the serial ports of the system. When the
// command ran, `status` is its exit status.
void add_gnss(CLI::App& app, int& status);

}  // namespace plumbline::commands
