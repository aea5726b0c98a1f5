// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/orient/network.h"
#include "edge/orient/terms.h"

namespace plumbline::orient {

inline constexpr int kRayColumns = kShared + Layout::kPose;

// A ray linearised: computed minus measured pixel, and its derivatives by (shared, pose of its
// photo) and by its point.
struct RayLinear {
  bool active = false;     // used, and in front of its camera
  double information = 0;  // weight / sigma^2, 1/px2
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, kRayColumns> by_common;
  Eigen::Matrix<double, 2, 3> by_point;
};

// The used rays linearised at one state, and what they cost there.
struct RaysLinear {
  std::vector<RayLinear> rays;
  double cost = 0;
};

// `cauchy_scale`: residuals beyond that many sigmas lose their weight as 1 / (1 + (r / scale)^2)
// (Cauchy); 0 = plain least squares. A used ray that cannot be projected (a point behind its
// camera) is inactive and costs more than any that can.
RaysLinear linearise_rays(const Network& network, const State& state, double cauchy_scale);

// Computed minus measured pixel; empty where the point cannot be projected.
std::optional<Eigen::Vector2d> residual_of(const Ray& ray, const State& state);

// A point about to be eliminated: V, g and E of  [N E; E' V] [dc; dp] = -[gc; gp].
struct PointBlock {
  bool active = false;
  Eigen::Matrix3d v = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  std::vector<int> columns;  // of the reduced system, one per row of e
  Eigen::Matrix<double, Eigen::Dynamic, 3> e;
};

struct NormalEquations {
  Eigen::MatrixXd n;         // columns x columns, before elimination
  Eigen::VectorXd gradient;  // of the reduced columns
  std::vector<PointBlock> points;
};

NormalEquations normal_equations(const Network& network, const std::vector<RayLinear>& rays,
                                 const std::vector<Term>& terms);

// A step of all unknowns.
struct Step {
  Eigen::VectorXd common;
  std::vector<Eigen::Vector3d> points;
};

// Solves with Marquardt damping (1 + lambda) on every diagonal; the points are eliminated (Schur
// complement). Empty where the damped system is not positive definite.
std::optional<Step> solve(const NormalEquations& equations, double lambda);

// The Schur complement over the eliminated points, undamped where lambda = 0.
Eigen::MatrixXd reduced_matrix(const NormalEquations& equations, double lambda);

State moved_by(const Network& network, const State& state, const Step& step);

}  // namespace plumbline::orient
