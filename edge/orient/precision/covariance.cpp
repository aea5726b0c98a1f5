// SPDX-License-Identifier: MIT
#include "edge/orient/precision/covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "edge/geometry/rotation.h"
#include "edge/orient/network/step.h"

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

// The rows and columns `columns` of a symmetric matrix.
Eigen::MatrixXd part_of(const Eigen::MatrixXd& whole, const std::vector<int>& columns) {
  const auto size = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd part(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const double* column = whole.col(columns[static_cast<std::size_t>(j)]).data();
    double* to = part.col(j).data();
    for (Eigen::Index i = 0; i < size; ++i) to[i] = column[columns[static_cast<std::size_t>(i)]];
  }
  return part;
}

// The covariance of w x u, both of mean zero and independent, to their covariances `turn` and
// `own`.
Eigen::Matrix3d turned(const Eigen::Matrix3d& own, const Eigen::Matrix3d& turn) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      sum += turn(i, j) * geometry::cross_matrix(Eigen::Vector3d::Unit(i)) * own *
             geometry::cross_matrix(Eigen::Vector3d::Unit(j)).transpose();
    }
  }
  return sum;
}

std::vector<int> groups_of_points(const Network& network) {
  std::vector<int> group_of_point(at(network.points()), -1);
  for (std::size_t g = 0; g < network.groups.size(); ++g) {
    for (const int p : network.groups[g].points) group_of_point[at(p)] = static_cast<int>(g);
  }
  return group_of_point;
}

}  // namespace

std::vector<PointFactor> point_factors(const Network& network, const NormalEquations& equations) {
  std::vector<PointFactor> factors(at(network.points()));
  for (const PointLanes& points : equations.points) {
    for (int lane = 0; lane < points.count; ++lane) {
      const int p = points.point[at(lane)];
      if (used_rays(network, p) >= 2) factors[at(p)] = eliminated(equations, points, lane);
    }
  }
  return factors;
}

std::optional<NetworkCovariance> NetworkCovariance::of(const Network& network,
                                                       const NormalEquations& equations) {
  NetworkCovariance out;
  if (!out.set_common(network, reduced_matrix(equations, 0))) return std::nullopt;
  out.columns_of_group_ = equations.columns_of_group;
  out.group_of_point_ = groups_of_points(network);
  for (const int slot : network.slot_of_photo)
    out.column_of_photo_.push_back(slot < 0 ? -1 : network.layout.photo(slot));
  out.points_ = point_factors(network, equations);
  for (const int p : network.layout.kept) {
    const int kept_index = network.layout.kept_of_point[at(p)];
    if (kept_index >= 0) out.points_[at(p)] = kept(network.layout.kept_point(kept_index));
  }
  return out;
}

bool NetworkCovariance::set_common(const Network& network, const Eigen::MatrixXd& reduced) {
  auto inverse = inverse_of(reduced);
  if (!inverse) return false;
  common_ = std::move(*inverse);
  for (int i = 0; i < kShared; ++i) {
    if (network.shared_mask[i] != 0) continue;
    common_.row(i).setZero();
    common_.col(i).setZero();
  }
  return true;
}

std::optional<NetworkCovariance> NetworkCovariance::with_reduced(
    const Network& network, const Eigen::MatrixXd& reduced) const {
  NetworkCovariance out = *this;
  if (!out.set_common(network, reduced)) return std::nullopt;
  return out;
}

// Each place along an arc is a variable z of its own, of variance 1: the columns move by step z,
// and a point by what the columns make of that and by the rest of its arc.
void NetworkCovariance::bend(double weight, const Step& step) {
  const Eigen::Index columns = step.common.size(), extra = common_.cols();
  common_.topLeftCorner(columns, columns) += weight * step.common * step.common.transpose();
  if (weight < 0) return;
  common_.conservativeResizeLike(Eigen::MatrixXd::Zero(extra + 1, extra + 1));
  const double root = std::sqrt(weight);
  common_.col(extra).head(columns) = root * step.common;
  common_.row(extra).head(columns) = root * step.common.transpose();
  common_(extra, extra) = 1;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    PointFactor& factor = points_[p];
    if (!factor.measured) continue;
    Eigen::Vector3d rest = step.points[p];
    for (std::size_t k = 0; k < factor.columns.size(); ++k) {
      const int column = factor.columns[k];
      if (column < columns)
        rest -= factor.by_common.col(static_cast<Eigen::Index>(k)) * step.common[column];
    }
    factor.columns.push_back(static_cast<int>(extra));
    factor.by_common.conservativeResize(Eigen::NoChange, factor.by_common.cols() + 1);
    factor.by_common.rightCols<1>() = root * rest;
  }
}

void NetworkCovariance::turn_own_parts(const Network& network) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (!points_[p].measured) continue;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
    int rays = 0;
    for (int k = network.first_ray[p]; k < network.first_ray[p + 1]; ++k) {
      if (!network.rays[at(k)].used) continue;
      const int rotation = network.layout.photo(network.rays[at(k)].slot) + 3;
      turn += common_.block<3, 3>(rotation, rotation);
      ++rays;
    }
    if (rays > 0) points_[p].own += turned(points_[p].own, turn / rays);
  }
}

void NetworkCovariance::add_next_order(const NetworkCovariance& first) {
  constexpr double kRounding = 1e-10;
  const Eigen::MatrixXd& before = first.common_;
  std::vector<int> varied;
  for (int i = 0; i < static_cast<int>(before.cols()); ++i) {
    if (before(i, i) > 0 && common_(i, i) > 0) varied.push_back(i);
  }
  // In units of each column's own sigma, for metres, pixels and radians stand side by side.
  const Eigen::VectorXd sigma = common_.diagonal()(varied).cwiseSqrt();
  const Eigen::VectorXd per_sigma = sigma.cwiseInverse();
  Eigen::MatrixXd whole = per_sigma.asDiagonal() * common_(varied, varied) * per_sigma.asDiagonal();
  whole.diagonal().array() += kRounding;
  const Eigen::MatrixXd linear =
      per_sigma.asDiagonal() * before(varied, varied) * per_sigma.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> axes(linear, whole);
  if (axes.info() != Eigen::Success || !axes.eigenvalues().allFinite()) return;
  const Eigen::VectorXd next = (1 - axes.eigenvalues().array()).max(0).square();
  const Eigen::MatrixXd by = sigma.asDiagonal() * (whole * axes.eigenvectors());
  common_(varied, varied) += by * next.asDiagonal() * by.transpose();
}

Eigen::MatrixXd NetworkCovariance::common_block(const std::vector<int>& rows,
                                                const std::vector<int>& cols) const {
  return common_(rows, cols);
}

Eigen::Matrix3d NetworkCovariance::point_covariance(int index) const {
  const PointFactor& f = point(index);
  return f.own + f.by_common * part_of(common_, f.columns) * f.by_common.transpose();
}

std::vector<Eigen::Matrix3d> NetworkCovariance::point_covariances() const {
  std::vector<Eigen::Matrix3d> out(points_.size(), Eigen::Matrix3d::Zero());
  const std::vector<int>* columns = nullptr;
  Eigen::MatrixXd common;
  Eigen::Matrix<double, 3, Eigen::Dynamic> product;
  for (const int p : by_group()) {
    const PointFactor& f = point(p);
    if (!f.measured) continue;
    if (columns == nullptr || f.columns != *columns) common = part_of(common_, f.columns);
    columns = &f.columns;
    product.noalias() = f.by_common * common;
    out[at(p)] = f.own + product * f.by_common.transpose();
  }
  return out;
}

// The points, those of the same columns one after the other.
std::vector<int> NetworkCovariance::by_group() const {
  std::vector<int> order(points_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return group_of_point_[at(a)] < group_of_point_[at(b)]; });
  return order;
}

Eigen::MatrixXd NetworkCovariance::joint(const std::vector<int>& points) const {
  const auto size = static_cast<Eigen::Index>(3 * points.size());
  Eigen::MatrixXd covariance(size, size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointFactor& a = point(points[i]);
    const Eigen::MatrixXd with_common = a.by_common * common_(a.columns, Eigen::all);
    for (std::size_t j = 0; j <= i; ++j) {
      const PointFactor& b = point(points[j]);
      Eigen::Matrix3d block = with_common(Eigen::all, b.columns) * b.by_common.transpose();
      if (points[i] == points[j]) block += a.own;
      const auto row = static_cast<Eigen::Index>(3 * i), col = static_cast<Eigen::Index>(3 * j);
      covariance.block<3, 3>(row, col) = block;
      covariance.block<3, 3>(col, row) = block.transpose();
    }
  }
  return covariance;
}

Eigen::MatrixXd NetworkCovariance::with_photo(int photo, const std::vector<int>& points) const {
  const int first = column_of_photo_[at(photo)];
  const Eigen::MatrixXd rows = common_.middleRows(first, Layout::kPose);
  Eigen::MatrixXd covariance(Layout::kPose, static_cast<Eigen::Index>(3 * points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointFactor& f = point(points[i]);
    covariance.middleCols<3>(static_cast<Eigen::Index>(3 * i)) =
        rows(Eigen::all, f.columns) * f.by_common.transpose();
  }
  return covariance;
}

PointSpread NetworkCovariance::spread(int index) const {
  const PointFactor& f = point(index);
  PointSpread out;
  out.columns = columns_of_group_[at(group_of_point_[at(index)])];
  if (f.columns == out.columns) {
    out.with_common.noalias() = f.by_common * part_of(common_, f.columns);
    out.own = f.own + out.with_common * f.by_common.transpose();
  } else {
    out.with_common = f.by_common * common_block(f.columns, out.columns);
    out.own = point_covariance(index);
  }
  return out;
}

// The pixel moves by Jc dc + Jp dp.
Eigen::Matrix2d NetworkCovariance::pixel_covariance(const Network& network, const Ray& ray,
                                                    const RayLinear& linear,
                                                    const PointSpread& spread) const {
  const int photo = network.layout.photo(ray.slot);
  Eigen::Matrix<double, kRayColumns, kRayColumns> common;
  common.topLeftCorner<kShared, kShared>() = common_.topLeftCorner<kShared, kShared>();
  common.topRightCorner<kShared, Layout::kPose>() = common_.block<kShared, Layout::kPose>(0, photo);
  common.bottomLeftCorner<Layout::kPose, kShared>() =
      common_.block<Layout::kPose, kShared>(photo, 0);
  common.bottomRightCorner<Layout::kPose, Layout::kPose>() =
      common_.block<Layout::kPose, Layout::kPose>(photo, photo);
  Eigen::Matrix<double, 3, kRayColumns> with_common = Eigen::Matrix<double, 3, kRayColumns>::Zero();
  for (std::size_t c = 0; c < spread.columns.size(); ++c) {
    const int column = spread.columns[c];
    const int in_photo = column - photo;
    if (column >= kShared && (in_photo < 0 || in_photo >= Layout::kPose)) continue;
    with_common.col(column < kShared ? column : kShared + in_photo) =
        spread.with_common.col(static_cast<Eigen::Index>(c));
  }
  const Eigen::Matrix<double, 2, kRayColumns> by_common = linear.by_common * common;
  const Eigen::Matrix<double, 2, kRayColumns> by_point = linear.by_point * with_common;
  const Eigen::Matrix2d crossed = by_point * linear.by_common.transpose();
  return linear.by_point * spread.own * linear.by_point.transpose() + crossed +
         crossed.transpose() + by_common * linear.by_common.transpose();
}

}  // namespace plumbline::orient
