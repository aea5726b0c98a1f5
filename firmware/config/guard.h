// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace plumbline::config {

struct Stray {
  std::size_t line;  // from 1
  std::string sentence;
};

// What a configuration needs nowhere and toml++ 3.3 does not bear: a character beyond ASCII outside
// of quotes and comments (undefined behaviour), text over several lines, which may hide one, and
// tables nested so deep that the stack ends. Empty: toml++ may read the text.
std::optional<Stray> stray_in(std::string_view text);

}  // namespace plumbline::config
