// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "firmware/config/config.h"

namespace plumbline::config {

// A file with every key, its meaning, range and default, from the table of key.h. Sections stand
// as they are; each key is behind a '#' with nothing between, each explanation behind "# ", so that
// "s/^#\([a-z]\)/\1/" makes a file that says the defaults.
std::string config_example();

// A file with every key at its value, without comments. It reads back as the same Config, also by
// a later version whose defaults differ.
std::string config_text(const Config& config);

}  // namespace plumbline::config
