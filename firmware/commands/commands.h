// SPDX-License-Identifier: MIT
#pragma once

namespace plumbline::commands {

// Runs the plumbline command line. Returns the exit status: 0 good, 1 the work failed (bad data,
// no solution), 2 wrong usage.
int run(int argc, char** argv);

inline constexpr int kWrongUsage = 2;

}  // namespace plumbline::commands
