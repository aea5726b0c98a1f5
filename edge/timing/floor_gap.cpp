// SPDX-License-Identifier: MIT
#include "edge/timing/floor_gap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::timing {
namespace {

// The prior of the power: gamma law of this shape and rate, mean 1.5, most of it from 0.4 to 3.5.
constexpr double kPowerShape = 3;
constexpr double kPowerRate = 2;
// What a receiver's latency varies by: the prior of the gap is exponential of this mean.
constexpr double kTailPrior_s = 20e-3;
// The distances that are weighed. Less than the first does not matter beside the host's own timer.
constexpr double kNearest_s = 5e-6;
constexpr double kFurthest_s = 0.3;
constexpr int kSteps = 60;

// Logarithm of the posterior density of a gap, but for a constant.
double log_density(std::span<const double> above_s, double gap_s) {
  const double highest_s = above_s.back() + gap_s;
  const auto others = static_cast<double>(above_s.size() - 1);
  double fall = 0;  // minus the sum of log(y / L)
  for (const double above : above_s) fall -= std::log((above + gap_s) / highest_s);
  return fall - (others + kPowerShape) * std::log(fall + kPowerRate) -
         others * std::log(highest_s) - gap_s / kTailPrior_s;
}

}  // namespace

FloorGap floor_gap(std::span<const double> above_s) {
  const double step = std::log(kFurthest_s / kNearest_s) / kSteps;
  std::array<double, kSteps + 1> gaps_s{};
  std::array<double, kSteps + 1> logs{};
  for (std::size_t i = 0; i < logs.size(); ++i) {
    gaps_s[i] = kNearest_s * std::exp(static_cast<double>(i) * step);
    // Steps are even in the logarithm: each stands for an interval as long as its gap.
    logs[i] = log_density(above_s, gaps_s[i]) + std::log(gaps_s[i]);
  }
  const double most = *std::max_element(logs.begin(), logs.end());
  double weight = 0;
  double sum_s = 0;
  double sum2_s2 = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double w = std::exp(logs[i] - most);
    weight += w;
    sum_s += w * gaps_s[i];
    sum2_s2 += w * gaps_s[i] * gaps_s[i];
  }
  const double mean_s = sum_s / weight;
  return {mean_s, std::sqrt(std::max(0.0, sum2_s2 / weight - mean_s * mean_s))};
}

}  // namespace plumbline::timing
