// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "edge/orient/solution.h"
#include "edge/orient/three_point_frame.h"

namespace plumbline::orient {

// First-order moves of (origin, x_axis, plane), three each, in the coordinates outside the frame.
using ByFrame = Eigen::Matrix<double, 3, 9>;

// How the frame itself moves when its points do, and so what a place in it does
// (S-transformation: Baarda 1973; Teunissen 1985): with d the move of a place outside,
//   d local = turn (d - d origin) + [local]x theta,
// theta being the small turn, about the frame's own axes, that keeps y and z of x_axis and z of
// plane at zero:
//   theta_z = day / xa,  theta_y = -daz / xa,  theta_x = (dbz + xb theta_y) / yb,
// where da, db are turn (d x_axis - d origin), turn (d plane - d origin).
class STransformation {
 public:
  explicit STransformation(const ThreePointFrame& frame);

  // By the frame's three points; by its own move a place moves as `turn` says.
  ByFrame place_by_frame(const Eigen::Vector3d& local) const;
  // The same for a rotation increment.
  ByFrame rotation_by_frame() const { return -theta_; }
  const Eigen::Matrix3d& turn() const { return turn_; }

 private:
  Eigen::Matrix3d turn_;
  ByFrame theta_;
};

// Covariances relative to the frame, out of those in any other datum.
class FrameCovariances final : public PointCovariances {
 public:
  // `in_frame`: a solution whose photos and points have their places in the frame already.
  FrameCovariances(std::shared_ptr<const PointCovariances> outside, const FrameRoles& roles,
                   const STransformation& transformation, const Solution& in_frame);

  Eigen::MatrixXd joint(const std::vector<int>& points) const override;
  Eigen::MatrixXd with_photo(int photo, const std::vector<int>& points) const override;
  // Of a photo in the frame, from its covariance `outside`.
  Matrix6d of_photo(int photo, const Matrix6d& outside) const;

 private:
  std::vector<int> with_frame(const std::vector<int>& points) const;
  Eigen::MatrixXd moves_of(const std::vector<int>& points) const;
  Eigen::Matrix<double, 6, 9> photo_by_frame(int photo) const;

  std::shared_ptr<const PointCovariances> outside_;
  FrameRoles roles_;
  STransformation s_;
  std::vector<Eigen::Vector3d> points_;   // local
  std::vector<Eigen::Vector3d> centres_;  // local, of photos
};

}  // namespace plumbline::orient
