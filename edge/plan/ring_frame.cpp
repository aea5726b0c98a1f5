// SPDX-License-Identifier: MIT
#include "edge/plan/ring_frame.h"

#include <Eigen/LU>

#include "edge/base/index.h"
#include "edge/geometry/rotation.h"

namespace plumbline::plan {
namespace {

using Matrix7 = Eigen::Matrix<double, 7, 7>;

// The point by all columns of the reduced system.
Eigen::Matrix<double, 3, Eigen::Dynamic> whole_row(const orient::PointFactor& factor,
                                                   Eigen::Index columns) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> row;
  row.setZero(3, columns);
  for (std::size_t c = 0; c < factor.columns.size(); ++c) {
    row.col(factor.columns[c]) = factor.by_common.col(static_cast<Eigen::Index>(c));
  }
  return row;
}

}  // namespace

RingFrame::RingFrame(const orient::State& state, const orient::NetworkCovariance& covariance,
                     const std::vector<int>& frame_points)
    : state_(state), covariance_(covariance) {
  const Eigen::Index columns = covariance.common().cols();
  by_common_.setZero(7, columns);
  std::vector<int> measured;
  for (const int p : frame_points) {
    if (covariance.point(p).measured) measured.push_back(p);
  }
  if (measured.size() < 3) return;
  for (const int p : measured) {
    centroid_m_ += state.points[at(p)] / static_cast<double>(measured.size());
  }
  Matrix7 normal = Matrix7::Zero();
  Eigen::Matrix<double, 7, Eigen::Dynamic> summed;
  summed.setZero(7, columns);
  for (const int p : measured) {
    const Eigen::Matrix<double, 3, 7> g = design(p);
    normal += g.transpose() * g;
    summed += g.transpose() * whole_row(covariance.point(p), columns);
  }
  const Eigen::FullPivLU<Matrix7> lu(normal);
  if (lu.isInvertible()) by_common_ = lu.inverse() * summed;
}

// dx = shift + rotation x (x - centroid) + scale (x - centroid).
Eigen::Matrix<double, 3, 7> RingFrame::design(int point) const {
  const Eigen::Vector3d from_centroid = state_.points[at(point)] - centroid_m_;
  Eigen::Matrix<double, 3, 7> g;
  g << Eigen::Matrix3d::Identity(), -geometry::cross_matrix(from_centroid), from_centroid;
  return g;
}

Eigen::Matrix3d RingFrame::local_covariance_m2(int point, const Eigen::Matrix3d& own) const {
  const Eigen::Matrix<double, 3, Eigen::Dynamic> about =
      whole_row(covariance_.point(point), covariance_.common().cols()) - design(point) * by_common_;
  return own + about * covariance_.common() * about.transpose();
}

}  // namespace plumbline::plan
