// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace plumbline::fuzz {

// Aborts, with a sentence on standard error, where config::parse_config breaks what it promises for
// this text: a Config within its ranges and at one with itself, whatever was wrong; that reads back
// from its own text as the same; errors that are one line each and name one of the file's.
void check_config(const std::string& text);

}  // namespace plumbline::fuzz
