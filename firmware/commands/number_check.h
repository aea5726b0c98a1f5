// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::commands {

// Of an option: a finite number from `least` to `most`. CLI::Range lets a NaN pass.
CLI::Validator number_within(double least, double most);

// A finite number above 0.
CLI::Validator number_above_zero();

}  // namespace plumbline::commands
