// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "edge/plan/plan.h"

namespace plumbline::plan {

// "0.03 mm", "4.2 mm", "1.2 cm", "1.30 m"; "unknown" where empty.
std::string length_in_words(std::optional<double> metres);

// The plan in a sentence or two: what the flight will reach, and what to do about it. "Height
// 2.1 cm, plan 1.2 cm, azimuth unknown: one more photo 10 m aside, at 90 m (12 s more) ..."
std::string sentence_of(const Summary& summary, const Options& options);

}  // namespace plumbline::plan
