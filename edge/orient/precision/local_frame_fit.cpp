// SPDX-License-Identifier: MIT
#include "edge/orient/precision/local_frame_fit.h"

#include <Eigen/LU>
#include <numeric>

#include "edge/base/median.h"
#include "edge/geometry/rotation.h"

namespace plumbline::orient {
namespace {

using Matrix3x7 = Eigen::Matrix<double, 3, 7>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

constexpr double kFarWorse = 3;  // times the median sigma

std::vector<int> all_of(const NetworkCovariance& covariance) {
  std::vector<int> points(at(covariance.points()));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

std::vector<int> frame_points(const NetworkCovariance& covariance,
                              const std::vector<Eigen::Matrix3d>& point_covariances,
                              const std::vector<int>& candidates) {
  std::vector<double> traces;
  for (const int p : candidates) {
    if (covariance.point(p).measured) traces.push_back(point_covariances[at(p)].trace());
  }
  std::vector<int> chosen;
  if (traces.empty()) return chosen;
  const double limit = kFarWorse * kFarWorse * upper_median(std::move(traces));
  for (const int p : candidates) {
    if (covariance.point(p).measured && point_covariances[at(p)].trace() <= limit) {
      chosen.push_back(p);
    }
  }
  return chosen;
}

// dx = shift + rotation x (x - centroid) + scale (x - centroid).
Matrix3x7 similarity_design(const Eigen::Vector3d& from_centroid) {
  Matrix3x7 g;
  g << Eigen::Matrix3d::Identity(), -geometry::cross_matrix(from_centroid), from_centroid;
  return g;
}

}  // namespace

LocalFrameFit fit_local_frame(const State& state, const NetworkCovariance& covariance,
                              const std::vector<Eigen::Matrix3d>& point_covariances,
                              const std::vector<int>& candidates) {
  LocalFrameFit fit;
  fit.local_covariance_m2 = point_covariances;
  const std::vector<int> chosen = frame_points(
      covariance, point_covariances, candidates.empty() ? all_of(covariance) : candidates);
  if (chosen.size() < 3) return fit;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const int p : chosen) centroid += state.points[at(p)] / static_cast<double>(chosen.size());
  Matrix7 normal = Matrix7::Zero();
  Eigen::MatrixXd summed = Eigen::MatrixXd::Zero(7, covariance.common().cols());
  Matrix7 own_sum = Matrix7::Zero();
  for (const int p : chosen) {
    const Matrix3x7 g = similarity_design(state.points[at(p)] - centroid);
    const PointFactor& factor = covariance.point(p);
    normal += g.transpose() * g;
    own_sum += g.transpose() * factor.own * g;
    const Eigen::MatrixXd rows = g.transpose() * factor.by_common;
    for (std::size_t c = 0; c < factor.columns.size(); ++c) {
      summed.col(factor.columns[c]) += rows.col(static_cast<Eigen::Index>(c));
    }
  }
  const Eigen::FullPivLU<Matrix7> lu(normal);
  if (!lu.isInvertible()) return fit;
  const Matrix7 a = lu.inverse();
  const Eigen::MatrixXd b = a * summed;  // similarity by columns
  fit.with_columns = covariance.common() * b.transpose();
  const Eigen::MatrixXd& cb = fit.with_columns;
  fit.determined = true;
  fit.common_covariance = b * cb + a * own_sum * a;
  std::vector<bool> in_frame(point_covariances.size(), false);
  for (const int p : chosen) in_frame[at(p)] = true;
  for (int p = 0; p < covariance.points(); ++p) {
    const PointFactor& factor = covariance.point(p);
    if (!factor.measured) continue;
    const Matrix3x7 g = similarity_design(state.points[at(p)] - centroid);
    Matrix3x7 with_common = factor.by_common * cb(factor.columns, Eigen::all);
    if (in_frame[at(p)]) with_common += factor.own * g * a;
    const Eigen::Matrix3d cross = with_common * g.transpose();
    fit.local_covariance_m2[at(p)] +=
        g * fit.common_covariance * g.transpose() - cross - cross.transpose();
  }
  return fit;
}

}  // namespace plumbline::orient
