// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace plumbline::service {

// Those of `names` that are folders of flights ("0007"), the oldest first: "10000" comes after
// "9999".
std::vector<std::string> flights_among(std::vector<std::string> names);

}  // namespace plumbline::service
