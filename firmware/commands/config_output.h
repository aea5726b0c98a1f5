// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "firmware/config/config_toml.h"

namespace plumbline::commands {

// What a configuration amounts to, in a few lines for a person.
std::string config_lines(const config::Config& config);

// One object: file, good, errors (sentences), config (sections of keys, as the file has them; where
// one is refused, its default) and heights_m, where photos are taken.
std::string config_json(const std::string& file, const config::ConfigReading& reading);

}  // namespace plumbline::commands
