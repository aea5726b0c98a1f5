// SPDX-License-Identifier: MIT
#include "sim/arrival_times.h"

#include <cmath>

namespace plumbline::sim {
namespace {

double exponential_s(double mean_s, Random& random) {
  return -mean_s * std::log(1 - random.uniform());
}

// A third of the epochs waits for what is left of a burst of 1.2 kB (10 bits per byte); all wait
// for the adapter's poll.
double behind_burst_s(Random& random) {
  constexpr double kBurst_s = 1200 * 10 / 38400.0;
  constexpr double kPoll_s = 16e-3;
  const double burst_s = random.uniform() < 1.0 / 3 ? random.uniform(0, kBurst_s / 2) : 0;
  return burst_s + exponential_s(5e-3, random) + random.uniform(0, kPoll_s);
}

double scheduled_s(Random& random) {
  const double usual_s = exponential_s(2e-3, random);
  return random.uniform() < 0.1 ? usual_s + random.uniform(50e-3, 2.0) : usual_s;
}

}  // namespace

std::string_view name_of(JitterLaw law) {
  switch (law) {
    case JitterLaw::kExponential:
      return "exponential";
    case JitterLaw::kUniform:
      return "uniform";
    case JitterLaw::kGamma:
      return "gamma";
    case JitterLaw::kBursts:
      return "bursts";
    case JitterLaw::kScheduling:
      return "scheduling";
  }
  return "";
}

double jitter_s(JitterLaw law, Random& random) {
  switch (law) {
    case JitterLaw::kExponential:
      return exponential_s(20e-3, random);
    case JitterLaw::kUniform:
      return random.uniform(0, 60e-3);
    case JitterLaw::kGamma:
      return exponential_s(15e-3, random) + exponential_s(15e-3, random);
    case JitterLaw::kBursts:
      return behind_burst_s(random);
    case JitterLaw::kScheduling:
      return scheduled_s(random);
  }
  return 0;
}

std::vector<double> crystal_errors_s(const CrystalOptions& options,
                                     const std::vector<double>& times_s, Random& random) {
  std::vector<double> errors_s;
  double rate = options.rate;
  double error_s = 0;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (k > 0) {
      const double step_s = times_s[k] - times_s[k - 1];
      rate += options.rate_walk_per_sqrt_s * std::sqrt(step_s) * random.normal();
      error_s += rate * step_s;
    }
    errors_s.push_back(error_s);
  }
  return errors_s;
}

}  // namespace plumbline::sim
