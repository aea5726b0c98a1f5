// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "sim/random.h"

namespace plumbline::sim {

// How much later than its least latency a receiver's epoch arrives.
enum class JitterLaw {
  kExponential,  // mean 20 ms
  kUniform,      // 0 to 60 ms
  kGamma,        // shape 2, mean 30 ms: few are near the least
  kBursts,     // 38400 baud: behind the burst of another output now and then, USB polled each 16 ms
  kScheduling  // 2 ms as a rule, one in ten late by 50 ms to 2 s
};

inline constexpr JitterLaw kJitterLaws[] = {JitterLaw::kExponential, JitterLaw::kUniform,
                                            JitterLaw::kGamma, JitterLaw::kBursts,
                                            JitterLaw::kScheduling};

std::string_view name_of(JitterLaw law);

// Seconds, at least 0; independent from epoch to epoch.
double jitter_s(JitterLaw law, Random& random);

// A crystal: its error of rate at the start (host seconds per true second, minus 1), and how far
// that walks at random in a second.
struct CrystalOptions {
  double rate = 40e-6;
  double rate_walk_per_sqrt_s = 0.02e-6;
};

// What the host clock shows, minus true time, at each of `times_s` (ascending from 0 at the first).
std::vector<double> crystal_errors_s(const CrystalOptions& options,
                                     const std::vector<double>& times_s, Random& random);

}  // namespace plumbline::sim
