// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
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

// Two digits, and those before the point where there are more.
inline std::string two_digits(double value) {
  constexpr double kThreeDigits = 99.5;
  return formatted(std::abs(value) < kThreeDigits ? "%.2g" : "%.0f", value);
}

}  // namespace plumbline::orient
