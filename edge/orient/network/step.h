// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/orient/network/normal_equations.h"

namespace plumbline::orient {

// A step of all unknowns.
struct Step {
  Eigen::VectorXd common;
  std::vector<Eigen::Vector3d> points;
};

Step scaled(Step step, double by);

// Solves with Marquardt damping (1 + lambda) on every diagonal; the points are eliminated (Schur
// complement). Empty where the damped system is not positive definite.
std::optional<Step> solve(const NormalEquations& equations, double lambda);

// Half of what the cost changes by along the step, to first order.
double slope_along(const NormalEquations& equations, const Step& step);

// The Schur complement over the eliminated points, undamped where lambda = 0. Symmetric.
Eigen::MatrixXd reduced_matrix(const NormalEquations& equations, double lambda);

State moved_by(const Network& network, const State& state, const Step& step);

}  // namespace plumbline::orient
