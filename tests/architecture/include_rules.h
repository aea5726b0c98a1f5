// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_text.h"

namespace plumbline::architecture {

struct Include {
  std::string header;
  bool quoted = false;  // "..." rather than <...>
  int line = 0;
};

// The #include lines of a source file; those inside comments and literals are not among them.
std::vector<Include> includes_of(std::string_view text);

// Includes that run against the arrows of the README:
//   firmware -> edge, drivers/*.h;  sim -> edge, drivers/*.h;  drivers -> drivers/*.h, edge/base;
//   edge -> edge, and among its rooms only downwards; tests -> anything; nothing -> tests,
//   firmware.
// Only the program that flies the real devices includes drivers/*/, and only those that simulate or
// replay include sim/. Includes name their header from the repository's root,
// but a test may name its neighbour.
std::vector<Violation> wrong_arrows(const SourceFile& file);

// Libraries outside the rooms that wrap them (OpenCV outside edge/image, Ceres outside tests, ...).
std::vector<Violation> strayed_libraries(const SourceFile& file);

// edge/ and sim/ open no file, read no clock, start no process, ask no environment and no device
// for randomness: the same input gives the same result.
std::vector<Violation> impure_mathematics(const SourceFile& file);

}  // namespace plumbline::architecture
