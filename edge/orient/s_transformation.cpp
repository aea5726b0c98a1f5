// SPDX-License-Identifier: MIT
#include "edge/orient/s_transformation.h"

#include <utility>

#include "edge/base/index.h"
#include "edge/geometry/rotation.h"

namespace plumbline::orient {
namespace {

constexpr Eigen::Index kFrame = 9;

ByFrame turn_by_moves(const ThreePointFrame& f) {
  const double xa = f.x_axis.x(), xb = f.plane.x(), yb = f.plane.y();
  Eigen::Matrix3d by_a = Eigen::Matrix3d::Zero(), by_b = by_a;
  by_a(2, 1) = 1 / xa;
  by_a(1, 2) = -1 / xa;
  by_a(0, 2) = -xb / (xa * yb);
  by_b(0, 2) = 1 / yb;
  ByFrame theta;
  theta << (-by_a - by_b) * f.turn, by_a * f.turn, by_b * f.turn;
  return theta;
}

// How many of a point's last coordinates are zero by definition.
int held(const FrameRoles& roles, int point) {
  if (point == roles.origin) return 3;
  if (point == roles.x_axis) return 2;
  return point == roles.plane ? 1 : 0;
}

Matrix6d twice(const Eigen::Matrix3d& turn) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = turn;
  both.bottomRightCorner<3, 3>() = turn;
  return both;
}

}  // namespace

STransformation::STransformation(const ThreePointFrame& frame)
    : turn_(frame.turn), theta_(turn_by_moves(frame)) {}

ByFrame STransformation::place_by_frame(const Eigen::Vector3d& local) const {
  ByFrame by = geometry::cross_matrix(local) * theta_;
  by.leftCols<3>() -= turn_;
  return by;
}

FrameCovariances::FrameCovariances(std::shared_ptr<const PointCovariances> outside,
                                   const FrameRoles& roles, const STransformation& transformation,
                                   const Solution& in_frame)
    : outside_(std::move(outside)), roles_(roles), s_(transformation) {
  for (const MeasuredPoint& point : in_frame.points) points_.push_back(point.in_enu_m);
  for (const OrientedPhoto& photo : in_frame.photos) centres_.push_back(photo.pose.centre_m);
}

std::vector<int> FrameCovariances::with_frame(const std::vector<int>& points) const {
  std::vector<int> all = {roles_.origin, roles_.x_axis, roles_.plane};
  all.insert(all.end(), points.begin(), points.end());
  return all;
}

// 3n x (9 + 3n). Rows that are zero by definition are set so, against rounding.
Eigen::MatrixXd FrameCovariances::moves_of(const std::vector<int>& points) const {
  const auto rows = static_cast<Eigen::Index>(3 * points.size());
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(rows, kFrame + rows);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    moves.block<3, kFrame>(row, 0) = s_.place_by_frame(points_[at(points[i])]);
    moves.block<3, 3>(row, kFrame + row) = s_.turn();
    const int zero = held(roles_, points[i]);
    moves.middleRows(row + 3 - zero, zero).setZero();
  }
  return moves;
}

Eigen::Matrix<double, 6, 9> FrameCovariances::photo_by_frame(int photo) const {
  Eigen::Matrix<double, 6, 9> by;
  by << s_.place_by_frame(centres_[at(photo)]), s_.rotation_by_frame();
  return by;
}

Eigen::MatrixXd FrameCovariances::joint(const std::vector<int>& points) const {
  const Eigen::MatrixXd moves = moves_of(points);
  return moves * outside_->joint(with_frame(points)) * moves.transpose();
}

Eigen::MatrixXd FrameCovariances::with_photo(int photo, const std::vector<int>& points) const {
  const std::vector<int> all = with_frame(points);
  const Eigen::MatrixXd of_frame = outside_->joint(all).topRows(kFrame);
  const Eigen::MatrixXd moved =
      twice(s_.turn()) * outside_->with_photo(photo, all) + photo_by_frame(photo) * of_frame;
  return moved * moves_of(points).transpose();
}

Matrix6d FrameCovariances::of_photo(int photo, const Matrix6d& outside) const {
  const std::vector<int> frame = with_frame({});
  const Matrix6d own = twice(s_.turn());
  const Eigen::Matrix<double, 6, 9> by = photo_by_frame(photo);
  const Matrix6d mixed = own * outside_->with_photo(photo, frame) * by.transpose();
  return own * outside * own.transpose() + mixed + mixed.transpose() +
         by * outside_->joint(frame) * by.transpose();
}

}  // namespace plumbline::orient
