// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace plumbline::architecture {

struct FunctionLength {
  int first_line = 0;  // of the opening brace, 1-based
  int lines = 0;       // opening to closing brace, both counted
};

// The bodies of the functions (and test cases) of a source file, lambdas counted with the function
// they stand in. Reads braces, not the language: right for code as clang-format leaves it.
std::vector<FunctionLength> function_lengths(std::string_view text);

}  // namespace plumbline::architecture
