// SPDX-License-Identifier: MIT
#include "edge/orient/covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "edge/orient/step.h"

namespace plumbline::orient {
namespace {

// Scaled to a unit diagonal first, since metres, radians and k3 differ by many powers of ten.
std::optional<Eigen::MatrixXd> inverse_of(const Eigen::MatrixXd& reduced) {
  const Eigen::VectorXd scale = reduced.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return std::nullopt;
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * reduced * scale.asDiagonal());
  if (factor.info() != Eigen::Success) return std::nullopt;
  const auto size = reduced.rows();
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(size, size));
  const Eigen::MatrixXd symmetric = 0.5 * (inverse + inverse.transpose());
  return scale.asDiagonal() * symmetric * scale.asDiagonal();
}

PointFactor eliminated(const NormalEquations& equations, const PointLanes& points, int lane) {
  PointFactor factor;
  factor.own = normal_of(points, lane).inverse();
  if (!factor.own.allFinite()) return factor;
  factor.measured = true;
  factor.columns = equations.columns_of_group[at(points.group)];
  factor.by_common = -(coupling_of(equations, points, lane) * factor.own).transpose();
  return factor;
}

PointFactor kept(int first_column) {
  PointFactor factor;
  factor.measured = true;
  factor.columns = {first_column, first_column + 1, first_column + 2};
  factor.by_common = Eigen::Matrix3d::Identity();
  return factor;
}

}  // namespace

std::optional<NetworkCovariance> NetworkCovariance::of(const Network& network,
                                                       const NormalEquations& equations) {
  NetworkCovariance out;
  auto inverse = inverse_of(reduced_matrix(equations, 0));
  if (!inverse) return std::nullopt;
  out.common_ = std::move(*inverse);
  for (int i = 0; i < kShared; ++i) {
    if (network.shared_mask[i] != 0) continue;
    out.common_.row(i).setZero();
    out.common_.col(i).setZero();
  }
  out.points_.resize(at(network.points()));
  out.measured_by_group_.resize(network.groups.size());
  for (const PointLanes& points : equations.points) {
    for (int lane = 0; lane < points.count; ++lane) {
      const int p = points.point[at(lane)];
      if (used_rays(network, p) < 2) continue;
      out.points_[at(p)] = eliminated(equations, points, lane);
      if (out.points_[at(p)].measured) out.measured_by_group_[at(points.group)].push_back(p);
    }
  }
  for (const int p : network.layout.kept) {
    const int kept_index = network.layout.kept_of_point[at(p)];
    if (kept_index < 0) continue;
    out.points_[at(p)] = kept(network.layout.kept_point(kept_index));
    out.measured_by_group_.push_back({p});
  }
  return out;
}

Eigen::MatrixXd NetworkCovariance::common_block(const std::vector<int>& rows,
                                                const std::vector<int>& cols) const {
  return common_(rows, cols);
}

Eigen::Matrix3d NetworkCovariance::point_covariance(int index) const {
  const PointFactor& f = point(index);
  return f.own + f.by_common * common_block(f.columns, f.columns) * f.by_common.transpose();
}

std::vector<Eigen::Matrix3d> NetworkCovariance::point_covariances() const {
  std::vector<Eigen::Matrix3d> out(points_.size(), Eigen::Matrix3d::Zero());
  for (const std::vector<int>& points : measured_by_group_) {
    if (points.empty()) continue;
    const std::vector<int>& columns = point(points.front()).columns;
    const Eigen::MatrixXd common = common_block(columns, columns);
    Eigen::Matrix<double, 3, Eigen::Dynamic> product(3, common.cols());
    for (const int p : points) {
      const PointFactor& f = point(p);
      product.noalias() = f.by_common * common;
      out[at(p)] = f.own + product * f.by_common.transpose();
    }
  }
  return out;
}

Eigen::MatrixXd NetworkCovariance::joint(const std::vector<int>& points) const {
  const auto size = static_cast<Eigen::Index>(3 * points.size());
  Eigen::MatrixXd covariance(size, size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointFactor& a = point(points[i]);
    for (std::size_t j = 0; j <= i; ++j) {
      const PointFactor& b = point(points[j]);
      Eigen::Matrix3d block =
          a.by_common * common_block(a.columns, b.columns) * b.by_common.transpose();
      if (i == j) block += a.own;
      const auto row = static_cast<Eigen::Index>(3 * i), col = static_cast<Eigen::Index>(3 * j);
      covariance.block<3, 3>(row, col) = block;
      covariance.block<3, 3>(col, row) = block.transpose();
    }
  }
  return covariance;
}

PointSpread NetworkCovariance::spread(int index) const {
  const PointFactor& f = point(index);
  PointSpread out;
  out.with_common = f.by_common * common_(f.columns, Eigen::all);
  out.own = f.own + out.with_common(Eigen::all, f.columns) * f.by_common.transpose();
  return out;
}

// The pixel moves by Jc dc + Jp dp.
Eigen::Matrix2d NetworkCovariance::pixel_covariance(const Network& network, const Ray& ray,
                                                    const RayLinear& linear,
                                                    const PointSpread& spread) const {
  std::vector<int> columns;
  for (int i = 0; i < kShared; ++i) columns.push_back(i);
  for (int i = 0; i < Layout::kPose; ++i) columns.push_back(network.layout.photo(ray.slot) + i);
  const Eigen::Matrix2d crossed =
      linear.by_point * spread.with_common(Eigen::all, columns) * linear.by_common.transpose();
  return linear.by_point * spread.own * linear.by_point.transpose() + crossed +
         crossed.transpose() +
         linear.by_common * common_block(columns, columns) * linear.by_common.transpose();
}

}  // namespace plumbline::orient
