// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_text.h"

namespace plumbline::architecture {

// The parts of the style card that a machine can judge. Each takes one file and gives what is wrong
// with it.

// The licence stands in the first line (the second after a #! line) of C++, CMake and shell files.
std::vector<Violation> missing_licence(const SourceFile& file);

// No source file over 500 lines; no function over 60.
std::vector<Violation> oversized(const SourceFile& file);

// A header guards itself with #pragma once.
std::vector<Violation> unguarded_header(const SourceFile& file);

// Marks of unfinished work, paths of one person's machine, host names of package registries.
std::vector<Violation> leftovers(const SourceFile& file);

bool is_cpp(const std::string& path);

}  // namespace plumbline::architecture
