// SPDX-License-Identifier: MIT
#include "edge/orient/network/step.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>

#include "edge/geometry/rotation.h"

namespace plumbline::orient {
namespace {

// Bundles whose outer products are summed in one matrix product. Its inner dimension stays below
// the block size of any cache, and with it the order of summation the same on every machine.
constexpr std::size_t kBundlesAtOnce = 8;
// A point that its rays leave open in a direction keeps this share of its diagonal there.
constexpr double kLeastPivotShare = 1e-14;
constexpr double kLeastPivot = 1e-290;  // a point without rays

// Columns that nothing touches (a camera parameter held fixed) stay where they are.
void pin_untouched(Eigen::MatrixXd& n) {
  for (Eigen::Index i = 0; i < n.rows(); ++i) {
    if (n(i, i) == 0) n(i, i) = 1;
  }
}

// V = L L' of each lane's point, under Marquardt scaling; a diagonal far below its neighbours' is
// floored, or damping would not reach a direction that the rays hardly see.
class PointFactors {
 public:
  PointFactors(const std::array<Lanes, 6>& v, double lambda) {
    const Lanes floor = 1e-9 * v[0].max(v[2]).max(v[5]);
    const Lanes xx = v[0] + lambda * v[0].max(floor), yy = v[2] + lambda * v[2].max(floor),
                zz = v[5] + lambda * v[5].max(floor);
    over_x_ = inverse_root(xx, xx);
    yx_ = v[1] * over_x_;
    zx_ = v[3] * over_x_;
    over_y_ = inverse_root(yy - yx_ * yx_, yy);
    zy_ = (v[4] - zx_ * yx_) * over_y_;
    over_z_ = inverse_root(zz - zx_ * zx_ - zy_ * zy_, zz);
  }

  // L^-1 b.
  Lanes3 forward(const Lanes3& b) const {
    Lanes3 x;
    x[0] = b[0] * over_x_;
    x[1] = (b[1] - yx_ * x[0]) * over_y_;
    x[2] = (b[2] - zx_ * x[0] - zy_ * x[1]) * over_z_;
    return x;
  }

  // L'^-1 b.
  Lanes3 backward(const Lanes3& b) const {
    Lanes3 x;
    x[2] = b[2] * over_z_;
    x[1] = (b[1] - zy_ * x[2]) * over_y_;
    x[0] = (b[0] - yx_ * x[1] - zx_ * x[2]) * over_x_;
    return x;
  }

 private:
  static Lanes inverse_root(const Lanes& pivot, const Lanes& diagonal) {
    return 1 / pivot.max(kLeastPivotShare * diagonal).max(kLeastPivot).sqrt();
  }

  Lanes over_x_, yx_, over_y_, zx_, zy_, over_z_;
};

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The Schur complement  S = N - E V^-1 E' = N - F F'  with  F = E L'^-1, and its right side
// -gc + F L^-1 gp: the points of a group go through one matrix product together.
class Elimination {
 public:
  Elimination(const NormalEquations& equations, double lambda)
      : equations_(equations), lambda_(lambda), s(equations.n), right_side(-equations.gradient) {
    pin_untouched(s);
    s.diagonal() *= 1 + lambda;
    const auto& points = equations.points;
    for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
      while (last < points.size() && points[last].group == points[first].group) ++last;
      eliminate(first, last);
    }
  }

 private:
  const NormalEquations& equations_;
  double lambda_;
  RowMajor f_;
  Eigen::MatrixXd product_;

 public:
  Eigen::MatrixXd s;  // lower triangle
  Eigen::VectorXd right_side;

 private:
  void eliminate(std::size_t first, std::size_t last) {
    const std::vector<int>& columns =
        equations_.columns_of_group[at(equations_.points[first].group)];
    const auto rows = static_cast<Eigen::Index>(columns.size()) + 1;
    product_.setZero(rows, rows);
    for (std::size_t from = first; from < last; from += kBundlesAtOnce) {
      const std::size_t to = std::min(from + kBundlesAtOnce, last);
      Eigen::Index width = 0;
      for (std::size_t b = from; b < to; ++b) width += 3 * equations_.points[b].count;
      f_.resize(rows, width);
      double* row = f_.data();
      for (std::size_t b = from; b < to; ++b) {
        put(equations_.points[b], columns.size(), row);
        row += 3 * equations_.points[b].count;
      }
      product_.selfadjointView<Eigen::Lower>().rankUpdate(f_);
    }
    subtract(columns);
  }

  // F of a bundle, and L^-1 gp below it.
  void put(const PointLanes& points, std::size_t rows, double* to) const {
    const PointFactors factors(points.v, lambda_);
    const auto put_row = [&](const Lanes3& row) {
      const Lanes3 f = factors.forward(row);
      for (int i = 0; i < 3; ++i) std::copy_n(f[at(i)].data(), points.count, to + i * points.count);
      to += f_.cols();
    };
    for (std::size_t r = 0; r < rows; ++r) put_row(equations_.e[points.first_e + r]);
    put_row(points.gradient);
  }

  // Where columns ascend, all stays in the lower triangle.
  void subtract(const std::vector<int>& columns) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      double* const to = s.col(columns[j]).data();
      const double* const from = product_.col(static_cast<Eigen::Index>(j)).data();
      for (std::size_t i = j; i < columns.size(); ++i) to[columns[i]] -= from[i];
      right_side[columns[j]] += from[columns.size()];
    }
    if (!std::is_sorted(columns.begin(), columns.end())) subtract_again(columns);
  }

  // A photo that sees the points twice has its columns twice, which meet on its diagonal block:
  // what subtract() put on its diagonal and above counts below it too.
  void subtract_again(const std::vector<int>& columns) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (columns[i] > columns[j]) continue;
        s(columns[j], columns[i]) -=
            product_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
};

// dp = V^-1 (-gp - E' dc).
Lanes3 point_steps(const NormalEquations& equations, const PointLanes& points, double lambda,
                   const Eigen::VectorXd& common) {
  Lanes3 right{-points.gradient[0], -points.gradient[1], -points.gradient[2]};
  const std::vector<int>& columns = equations.columns_of_group[at(points.group)];
  for (std::size_t r = 0; r < columns.size(); ++r) {
    const double moved = common[columns[r]];
    const Lanes3& e = equations.e[points.first_e + r];
    for (std::size_t i = 0; i < 3; ++i) right[i] -= moved * e[i];
  }
  const PointFactors factors(points.v, lambda);
  return factors.backward(factors.forward(right));
}

// What all photos turn by together is followed as the rotation it is, about the middle of the
// stations, and only the rest as a straight line: a turn of the whole changes no image, and as a
// straight line it could take but tiny steps before the points left their rays. To first order the
// same as adding the step.
class WholeTurn {
 public:
  WholeTurn(const Layout& layout, const State& state, const Step& step) {
    for (int slot = 0; slot < layout.slots; ++slot) {
      turn_rad_ += step.common.segment<3>(layout.photo(slot) + 3) / layout.slots;
      centre_m_ += state.poses[at(slot)].centre_m / layout.slots;
    }
    rotation_ = geometry::rotation_by(turn_rad_);
  }

  Eigen::Vector3d place(const Eigen::Vector3d& from, const Eigen::Vector3d& step) const {
    const Eigen::Vector3d arm = from - centre_m_;
    return centre_m_ + rotation_ * (arm + step - turn_rad_.cross(arm));
  }
  Eigen::Matrix3d attitude(const Eigen::Matrix3d& from, const Eigen::Vector3d& step_rad) const {
    return rotation_ * geometry::rotation_by(step_rad - turn_rad_) * from;
  }

 private:
  Eigen::Vector3d turn_rad_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre_m_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

}  // namespace

Eigen::MatrixXd reduced_matrix(const NormalEquations& equations, double lambda) {
  Eigen::MatrixXd s = Elimination(equations, lambda).s;
  s.triangularView<Eigen::StrictlyUpper>() = s.transpose();
  return s;
}

std::optional<Step> solve(const NormalEquations& equations, double lambda) {
  Elimination reduced(equations, lambda);
  Eigen::MatrixXd& s = reduced.s;
  const Eigen::VectorXd scale = s.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-150).cwiseInverse();
  s = scale.asDiagonal() * s * scale.asDiagonal();
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(s);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Step step;
  step.common = scale.asDiagonal() * factor.solve(scale.asDiagonal() * reduced.right_side);
  if (!step.common.allFinite()) return std::nullopt;
  step.points.assign(equations.point_count, Eigen::Vector3d::Zero());
  for (const PointLanes& points : equations.points) {
    const Lanes3 moved = point_steps(equations, points, lambda, step.common);
    for (int lane = 0; lane < points.count; ++lane) {
      Eigen::Vector3d& to = step.points[at(points.point[at(lane)])];
      to = {moved[0][lane], moved[1][lane], moved[2][lane]};
      if (!to.allFinite()) return std::nullopt;
    }
  }
  return step;
}

Step scaled(Step step, double by) {
  step.common *= by;
  for (Eigen::Vector3d& point : step.points) point *= by;
  return step;
}

double slope_along(const NormalEquations& equations, const Step& step) {
  double slope = equations.gradient.dot(step.common);
  for (const PointLanes& points : equations.points) {
    for (int lane = 0; lane < points.count; ++lane) {
      const Eigen::Vector3d& moved = step.points[at(points.point[at(lane)])];
      for (std::size_t i = 0; i < 3; ++i)
        slope += points.gradient[i][lane] * moved[static_cast<Eigen::Index>(i)];
    }
  }
  return slope;
}

State moved_by(const Network& network, const State& state, const Step& step) {
  State moved = state;
  const Layout& layout = network.layout;
  const WholeTurn whole(layout, state, step);
  moved.interior += step.common.head<geometry::kInteriorCount>();
  moved.line_time_s += step.common[kLineTime];
  moved.delay_s += step.common[kDelay];
  for (int slot = 0; slot < layout.slots; ++slot) {
    geometry::Pose& pose = moved.poses[at(slot)];
    const int column = layout.photo(slot);
    pose.centre_m = whole.place(pose.centre_m, step.common.segment<3>(column));
    pose.ground_from_photo =
        whole.attitude(pose.ground_from_photo, step.common.segment<3>(column + 3));
  }
  for (std::size_t p = 0; p < moved.points.size(); ++p) {
    const int kept = layout.kept_of_point[p];
    const Eigen::Vector3d own =
        kept >= 0 ? Eigen::Vector3d(step.common.segment<3>(layout.kept_point(kept)))
                  : step.points[p];
    moved.points[p] = whole.place(moved.points[p], own);
  }
  return moved;
}

}  // namespace plumbline::orient
