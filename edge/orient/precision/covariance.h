// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/network/normal_equations.h"
#include "edge/orient/network/step.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// The covariance of all unknowns at the end of a plain least-squares adjustment, kept in factors:
// a point is  dp = by_common * d(columns) + own part,  with the own part independent of everything.
struct PointFactor {
  bool measured = false;
  std::vector<int> columns;
  Eigen::Matrix<double, 3, Eigen::Dynamic> by_common;
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
};

// A point's covariance, and its covariance with the columns that its rays touch.
struct PointSpread {
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  std::vector<int> columns;  // of the reduced system
  Eigen::Matrix<double, 3, Eigen::Dynamic> with_common;
};

// By point, where its rays alone determine it: not measured where they do not, or where it is a
// column of the reduced system itself.
std::vector<PointFactor> point_factors(const Network& network, const NormalEquations& equations);

class NetworkCovariance final : public PointCovariances {
 public:
  // Empty where the reduced matrix is singular to working precision.
  static std::optional<NetworkCovariance> of(const Network& network,
                                             const NormalEquations& equations);

  // The same with another reduced matrix, of less information. Empty where it is singular.
  std::optional<NetworkCovariance> with_reduced(const Network& network,
                                                const Eigen::MatrixXd& reduced) const;

  // columns x columns; a bent one has more, of the places that bent it.
  const Eigen::MatrixXd& common() const { return common_; }
  const PointFactor& point(int index) const { return points_[static_cast<std::size_t>(index)]; }
  int points() const { return static_cast<int>(points_.size()); }

  Eigen::Matrix3d point_covariance(int index) const;
  // Of all points at once; zero where a point is not measured.
  std::vector<Eigen::Matrix3d> point_covariances() const;
  // by_common of `index` times the common covariance times `right` (columns x k).
  Eigen::MatrixXd joint(const std::vector<int>& points) const override;
  Eigen::MatrixXd with_photo(int photo, const std::vector<int>& points) const override;
  PointSpread spread(int index) const;
  // Covariance of the computed pixel of a ray; `spread` is that of its point.
  Eigen::Matrix2d pixel_covariance(const Network& network, const Ray& ray, const RayLinear& linear,
                                   const PointSpread& spread) const;

  // Adds weight * step step'; where the points' part of `step` is not what the common part makes of
  // it, the weight must be positive.
  void bend(double weight, const Step& step);

  // Lets the own part of each point turn with the photos that see it: a point that is known worst
  // along its rays is so along another line where the rays are turned by what they may be. Adds
  // the second moment of the product, E[(w x u)(w x u)'] of a turn w and an own error u.
  void turn_own_parts(const Network& network);

  // Where this covariance of the columns C is beyond `first`, the one of first order C1, by what a
  // series added to it, the term that was left off is taken to be to the last as that is to the
  // whole: with C = C1 + D, adds D C^-1 D. Axes in which C is less than C1 stay as they are.
  void add_next_order(const NetworkCovariance& first);

 private:
  bool set_common(const Network& network, const Eigen::MatrixXd& reduced);
  std::vector<int> by_group() const;
  Eigen::MatrixXd common_block(const std::vector<int>& rows, const std::vector<int>& cols) const;

  Eigen::MatrixXd common_;
  std::vector<PointFactor> points_;
  std::vector<std::vector<int>> columns_of_group_;  // as NormalEquations'
  std::vector<int> group_of_point_;                 // -1: no rays
  std::vector<int> column_of_photo_;                // -1: not oriented
};

}  // namespace plumbline::orient
