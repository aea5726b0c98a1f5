// SPDX-License-Identifier: MIT
#include "edge/orient/network/minimise.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "edge/orient/network/normal_equations.h"
#include "edge/orient/network/step.h"

namespace plumbline::orient {
namespace {

constexpr double kFirstLambda = 1e-4;
constexpr double kLeastLambda = 1e-12;
constexpr double kMostLambda = 1e8;
constexpr double kDampingFactor = 8;
constexpr double kNearlyUndamped = 1e-3;
// A step that lowers the cost by less than this share of what the linearised problem promised went
// too far along some direction, and the next one would swing back as far: it is damped more.
constexpr double kPoorGain = 0.25;
// The cost is a chi-square: what is left of such a gain is far below one sigma of anything.
constexpr double kNegligible = 1e-10;
// What summing some ten thousand squares leaves.
constexpr double kRounding = 1e-11;

class Minimiser {
 public:
  Minimiser(const Network& network, const State& start, const TermOptions& terms,
            const MinimiseOptions& options)
      : network_(network),
        start_(start),
        options_of_terms_(terms),
        options_(options),
        bundles_(bundles_of(network)) {}

  Minimum run(const State& from) {
    minimum_.state = from;
    terms_ = linearised_terms(network_, from, start_, options_of_terms_);
    minimum_.cost = cost(from, terms_);
    while (!minimum_.converged && minimum_.iterations < options_.max_iterations) {
      normal_equations(network_, bundles_, minimum_.state, options_.cauchy_scale, terms_,
                       equations_);
      ++minimum_.iterations;
      if (!step_down()) break;
    }
    return minimum_;
  }

 private:
  double cost(const State& state, const std::vector<Term>& terms) const {
    return cost_of(network_, bundles_, state, options_.cauchy_scale) + cost_of(terms);
  }

  // Raises the damping until a step lowers the cost; damping that had to be raised stays for the
  // next step, which would need it as well. False where no step lowers the cost.
  bool step_down() {
    bool raised = false;
    for (; lambda_ <= kMostLambda; lambda_ *= kDampingFactor, raised = true) {
      const auto step = solve(equations_, lambda_);
      if (!step) continue;
      const double promised = -slope_along(equations_, *step);
      // Less than rounding may hide: there is nothing left to go for.
      if (promised <= kNegligible && lambda_ < kNearlyUndamped) {
        minimum_.converged = true;
        return true;
      }
      State trial = moved_by(network_, minimum_.state, *step);
      auto terms = linearised_terms(network_, trial, start_, options_of_terms_);
      const double there = cost(trial, terms);
      if (!(there <= minimum_.cost)) {
        // At the bottom, rounding alone may lift the cost.
        if (there - minimum_.cost <= kRounding * minimum_.cost) minimum_.converged = true;
        if (minimum_.converged) return true;
        continue;
      }
      const double gain = minimum_.cost - there;
      const double least = std::max(options_.tolerance * minimum_.cost, kNegligible);
      minimum_.converged = gain <= least && lambda_ < kNearlyUndamped;
      const bool poor = gain < kPoorGain * promised;
      minimum_.state = std::move(trial);
      minimum_.cost = there;
      terms_ = std::move(terms);
      if (poor) {
        lambda_ *= kDampingFactor;
      } else if (!raised) {
        lambda_ = std::max(lambda_ / kDampingFactor, kLeastLambda);
      }
      return true;
    }
    return false;
  }

  const Network& network_;
  const State& start_;
  const TermOptions& options_of_terms_;
  const MinimiseOptions& options_;
  const Bundles bundles_;
  Minimum minimum_;
  std::vector<Term> terms_;
  NormalEquations equations_;
  double lambda_ = kFirstLambda;
};

}  // namespace

Minimum minimise(const Network& network, const State& state, const State& start,
                 const TermOptions& terms, const MinimiseOptions& options) {
  return Minimiser(network, start, terms, options).run(state);
}

}  // namespace plumbline::orient
