// SPDX-License-Identifier: MIT
#include "edge/orient/minimise.h"

#include <algorithm>

#include "edge/orient/normal_equations.h"

namespace plumbline::orient {
namespace {

constexpr double kFirstLambda = 1e-4;
constexpr double kLeastLambda = 1e-12;
constexpr double kMostLambda = 1e8;
constexpr double kNearlyUndamped = 1e-3;
// What summing some ten thousand squares leaves.
constexpr double kRounding = 1e-11;

struct Evaluated {
  RaysLinear rays;
  std::vector<Term> terms;
  double cost = 0;
};

class Minimiser {
 public:
  Minimiser(const Network& network, const State& start, const TermOptions& terms,
            const MinimiseOptions& options)
      : network_(network), start_(start), terms_(terms), options_(options) {}

  Minimum run(const State& from) {
    minimum_.state = from;
    current_ = evaluate(from);
    while (!minimum_.converged && minimum_.iterations < options_.max_iterations) {
      const NormalEquations equations =
          normal_equations(network_, current_.rays.rays, current_.terms);
      ++minimum_.iterations;
      if (!step_down(equations)) break;
    }
    minimum_.cost = current_.cost;
    return minimum_;
  }

 private:
  Evaluated evaluate(const State& state) const {
    Evaluated out{linearise_rays(network_, state, options_.cauchy_scale),
                  linearised_terms(network_, state, start_, terms_), 0};
    out.cost = out.rays.cost + cost_of(out.terms);
    return out;
  }

  // Raises the damping until a step lowers the cost. False where none does.
  bool step_down(const NormalEquations& equations) {
    for (; lambda_ <= kMostLambda; lambda_ *= 8) {
      const auto step = solve(equations, lambda_);
      if (!step) continue;
      const State trial = moved_by(network_, minimum_.state, *step);
      Evaluated there = evaluate(trial);
      if (!(there.cost <= current_.cost)) {
        // At the bottom, rounding alone may lift the cost.
        if (there.cost - current_.cost <= kRounding * current_.cost) minimum_.converged = true;
        if (minimum_.converged) return true;
        continue;
      }
      const double gain = current_.cost - there.cost;
      minimum_.converged = gain <= options_.tolerance * current_.cost && lambda_ < kNearlyUndamped;
      minimum_.state = trial;
      current_ = std::move(there);
      lambda_ = std::max(lambda_ / 8, kLeastLambda);
      return true;
    }
    return false;
  }

  const Network& network_;
  const State& start_;
  const TermOptions& terms_;
  const MinimiseOptions& options_;
  Minimum minimum_;
  Evaluated current_;
  double lambda_ = kFirstLambda;
};

}  // namespace

Minimum minimise(const Network& network, const State& state, const State& start,
                 const TermOptions& terms, const MinimiseOptions& options) {
  return Minimiser(network, start, terms, options).run(state);
}

}  // namespace plumbline::orient
