// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/config/config.h"

namespace plumbline::config {

inline constexpr std::size_t kMostHeights = 500;  // in one flight

// Values that are each within their range, but not together.
struct Disagreement {
  struct Place {
    std::string_view section;
    std::string_view key;
  };
  std::vector<Place> between;
  std::string sentence;  // what, and what to write instead
};

// The heights in metres, ascending. Precondition: first_m <= last_m, step_m > 0.
std::vector<double> heights_of(const Heights& heights);

// Looks for values that do not go together, and puts the defaults in their place; then fills
// capture.plan.heights_m.
std::vector<Disagreement> settle(Config& config);

}  // namespace plumbline::config
