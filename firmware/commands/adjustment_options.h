// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include "edge/orient/adjust.h"

namespace plumbline::commands {

// The options of the adjustment that `measure` and `orient` share.
void add_adjustment_options(CLI::App& sub, orient::Options& options);

}  // namespace plumbline::commands
