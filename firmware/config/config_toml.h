// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "firmware/config/config.h"

namespace plumbline::config {

// What a configuration file says. Its keys and their ranges: plumbline_example.toml, which
// config_text.h writes from the table of key.h. A key that is left out has its default.
struct ConfigReading {
  // Always within its ranges and at one with itself: where a value is refused, the default stands,
  // so that who must fly can. A file that is no TOML gives the defaults.
  Config config;
  // All that is wrong, by line, each "name:line: what, and what to write instead". None: good.
  std::vector<Error> errors;
};

// `name` is the file's name for sentences.
ConfigReading parse_config(const std::string& text, const std::string& name);

// Fails where the file is missing or cannot be read; what is wrong in it is in the reading.
Result<ConfigReading> read_config(const std::filesystem::path& path);

}  // namespace plumbline::config
