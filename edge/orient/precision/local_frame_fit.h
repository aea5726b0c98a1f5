// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/precision/covariance.h"

namespace plumbline::orient {

// The uncertainty of the points split into what they share and what is each one's own. Shared: the
// seven-parameter similarity that best fits all of them (shift of the centroid in m, rotation
// about it in rad, relative scale); own: what remains about it.
struct LocalFrameFit {
  Eigen::Matrix<double, 7, 7> common_covariance = Eigen::Matrix<double, 7, 7>::Zero();
  // Its covariance with the columns of the reduced system, columns x 7.
  Eigen::MatrixXd with_columns;
  bool determined = false;                           // false: too few points, or all on one line
  std::vector<Eigen::Matrix3d> local_covariance_m2;  // by point; zero where not measured
};

// Points whose own height is far worse than the others' (at the foot of a climb) do not help to
// define the frame. With fewer than three good points the local covariance is the whole one.
// `candidates`: the frame is fitted to none but these points; empty: to any.
LocalFrameFit fit_local_frame(const State& state, const NetworkCovariance& covariance,
                              const std::vector<Eigen::Matrix3d>& point_covariances,
                              const std::vector<int>& candidates = {});

}  // namespace plumbline::orient
