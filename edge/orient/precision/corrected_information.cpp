// SPDX-License-Identifier: MIT
#include "edge/orient/precision/corrected_information.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "edge/orient/network/step.h"

namespace plumbline::orient {
namespace {

constexpr double kMostBorrowed = 0.75;

// The state with every eliminated point moved by so many sigmas of its own, along the direction in
// which it is known worst.
State shifted_points(const Network& network, State state, const NetworkCovariance& covariance,
                     double sigmas) {
  for (int p = 0; p < network.points(); ++p) {
    const PointFactor& factor = covariance.point(p);
    if (!factor.measured || network.layout.kept_of_point[at(p)] >= 0) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(factor.own);
    state.points[at(p)] +=
        sigmas * std::sqrt(std::max(0.0, modes.eigenvalues()[2])) * modes.eigenvectors().col(2);
  }
  return state;
}

}  // namespace

NetworkCovariance without_borrowed(const Network& network, const State& state, const State& datum,
                                   const TermOptions& terms, const NetworkCovariance& straight) {
  const auto linear = linearised_terms(network, state, datum, terms);
  const auto reduced_at = [&](const State& place) {
    return reduced_matrix(normal_equations(network, place, 0, linear), 0);
  };
  const Eigen::MatrixXd here = reduced_at(state);
  const Eigen::MatrixXd around = 0.5 * (reduced_at(shifted_points(network, state, straight, 1)) +
                                        reduced_at(shifted_points(network, state, straight, -1)));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(around - here, here);
  if (modes.info() != Eigen::Success || !modes.eigenvalues().allFinite()) return straight;
  // A = S (1 - borrowed), so that A S^-1 A = S (1 - borrowed)^2.
  const Eigen::ArrayXd owned = 1 - modes.eigenvalues().array().max(0).min(kMostBorrowed);
  const Eigen::VectorXd lost = 1 - owned.square();
  const Eigen::MatrixXd by = here * modes.eigenvectors();
  const Eigen::MatrixXd left = here - by * lost.asDiagonal() * by.transpose();
  return straight.with_reduced(network, 0.5 * (left + left.transpose())).value_or(straight);
}

}  // namespace plumbline::orient
