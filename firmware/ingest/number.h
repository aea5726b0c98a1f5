// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumbline::ingest {

// The finite number that `text` is, all of it: a leading '+' is allowed, blanks around it too;
// empty for anything else (nan, inf, hexadecimal, a decimal comma, units behind). Independent of
// the locale.
std::optional<double> parse_number(std::string_view text);

// The shortest decimal that reads back as the same double.
std::string shortest(double value);

std::string_view trimmed(std::string_view text);

}  // namespace plumbline::ingest
