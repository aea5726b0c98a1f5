// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace plumbline::config {

// What stands behind a key of the file; monostate: a date, a table, a list of other things.
using Value = std::variant<std::monostate, bool, double, std::string, std::vector<double>>;

// The shortest figures that read back as the same double, without an exponent where it is legible.
std::string figures(double number);

// As TOML has it; a number reads back as the same double. Text is escaped as JSON has it, too.
std::string toml_of(const Value& value);

// Text of a file in a sentence for a person: one line of at most 60 printable characters.
std::string shown(std::string_view text);

}  // namespace plumbline::config
