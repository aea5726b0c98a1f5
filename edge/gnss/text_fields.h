// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace plumbline::gnss {

// Strict reading of the numbers that receivers write. Each returns empty for anything but a whole
// field of the stated form: no sign but a leading '-', no exponent, no blanks, no trailing text.

std::vector<std::string_view> split(std::string_view text, std::string_view separators,
                                    bool skip_empty);

// Digits with an optional point, up to 24 characters; correctly rounded to the nearest double.
std::optional<double> decimal(std::string_view field);

// Up to nine digits and nothing else.
std::optional<int> whole_number(std::string_view field);

// "28.45" as a duration; digits beyond the microsecond are rounded half up.
std::optional<std::chrono::microseconds> seconds(std::string_view field);

// hhmmss[.fff]: time since midnight. Second 60 (a leap second) counts on into the next minute.
std::optional<std::chrono::microseconds> time_of_day(std::string_view field);

// dddmm.mmmm with `degree_digits` digits of degrees (2 or 3) to degrees, unsigned, at most
// `max_deg`. The error is below 1e-13 degrees.
std::optional<double> degrees_and_minutes(std::string_view field, std::size_t degree_digits,
                                          double max_deg);

}  // namespace plumbline::gnss
