// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "edge/orient/network/bundles.h"
#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::orient {

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

// What the used rays cost at `state`.
double cost_of(const Network& network, const Bundles& bundles, const State& state,
               double cauchy_scale);

// Computed minus measured pixel; empty where the point cannot be projected.
std::optional<Eigen::Vector2d> residual_of(const Ray& ray, const State& state);

// The points of a bundle about to be eliminated: V, g and E of  [N E; E' V] [dc; dp] = -[gc; gp]
// (Schur complement; Brown 1976), one point in each lane.
struct PointLanes {
  int group = 0;  // of Network::groups
  int count = 0;
  std::array<int, kLanes> point{};
  std::array<Lanes, 6> v;  // xx, yx, yy, zx, zy, zz
  Lanes3 gradient;
  std::size_t first_e = 0;  // of NormalEquations::e: a row for each of its group's columns
};

struct NormalEquations {
  Eigen::MatrixXd n;         // columns x columns before elimination; its lower triangle is filled
  Eigen::VectorXd gradient;  // of the reduced columns
  std::vector<std::vector<int>> columns_of_group;  // that the rays of its points touch
  std::vector<PointLanes> points;                  // group by group, without the kept ones
  std::vector<Lanes3> e;
  std::size_t point_count = 0;  // of the network
};

// The normal equations at `state` of the used rays, weighted as linearise_rays does, and of
// `terms`. `out` keeps its memory from one call to the next.
void normal_equations(const Network& network, const Bundles& bundles, const State& state,
                      double cauchy_scale, const std::vector<Term>& terms, NormalEquations& out);
NormalEquations normal_equations(const Network& network, const State& state, double cauchy_scale,
                                 const std::vector<Term>& terms);

// The undamped 3x3 block of the point in `lane`, and its rows of E (columns of its group x 3).
Eigen::Matrix3d normal_of(const PointLanes& points, int lane);
Eigen::Matrix<double, Eigen::Dynamic, 3> coupling_of(const NormalEquations& equations,
                                                     const PointLanes& points, int lane);

}  // namespace plumbline::orient
