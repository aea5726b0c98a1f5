// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "firmware/deliver/product.h"

namespace plumbline::commands {

// What --distance, --area and --volume ask for, as written.
struct DerivedArguments {
  std::vector<std::string> distances, areas, volumes;
};

void add_derived_options(CLI::App& sub, DerivedArguments& arguments);

// Computes them from the product's solution and puts them into it. Fails with a sentence where an
// argument cannot be read, or names a point that was not measured.
Status add_derived_figures(const DerivedArguments& arguments, deliver::Product& product);

// Compares the product's solution with the known points and puts that into it. Where all of them
// were control, nothing is left to compare, and a warning says so. Fails where none was measured.
Status add_check(const std::vector<survey::CheckPoint>& known, deliver::Product& product);

}  // namespace plumbline::commands
