// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

namespace plumbline::orient {

// Text as snprintf() makes it, for the sentences of a summary: at most 511 characters.
template <typename... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, arguments...);
  return buffer;
}

}  // namespace plumbline::orient
