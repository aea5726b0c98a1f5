// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/precision/covariance.h"

namespace plumbline::plan {

// The seven-parameter similarity (shift, rotation, scale) that best fits the ground given by
// `frame_points`, as orient::LocalFrameFit but for a ground that is measured at more points than
// can be counted: what its points err by on their own averages out of the frame, and one point
// that is looked at is no part of it.
class RingFrame {
 public:
  // Fewer than three measured points, or all on one line: nothing is removed.
  RingFrame(const orient::State& state, const orient::NetworkCovariance& covariance,
            const std::vector<int>& frame_points);

  // Covariance of a measured point about the frame, m2. `own` is the point's own part.
  Eigen::Matrix3d local_covariance_m2(int point, const Eigen::Matrix3d& own) const;

 private:
  Eigen::Matrix<double, 3, 7> design(int point) const;

  const orient::State& state_;
  const orient::NetworkCovariance& covariance_;
  Eigen::Vector3d centroid_m_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 7, Eigen::Dynamic> by_common_;  // similarity by columns
};

}  // namespace plumbline::plan
