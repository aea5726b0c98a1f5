// SPDX-License-Identifier: MIT
#include "tests/bench/ceres_analytic.h"

#include <ceres/rotation.h>

#include <cmath>

#include "edge/geometry/rotation.h"

namespace plumbline::bench {
namespace {

constexpr double kSmallTurn = 1e-4;

using RowsByThree = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using RowsBySix = Eigen::Matrix<double, 2, 6, Eigen::RowMajor>;
using RowsByTen = Eigen::Matrix<double, 2, geometry::kInteriorCount, Eigen::RowMajor>;

// J = I + (1 - cos t) / t^2 [w]x + (t - sin t) / t^3 [w]x^2 with t = |w|.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double t2 = w.squaredNorm(), t = std::sqrt(t2);
  const double a = t < kSmallTurn ? 0.5 - t2 / 24 : (1 - std::cos(t)) / t2;
  const double b = t < kSmallTurn ? 1.0 / 6 - t2 / 120 : (t - std::sin(t)) / (t2 * t);
  const Eigen::Matrix3d x = geometry::cross_matrix(w);
  return Eigen::Matrix3d::Identity() + a * x + b * x * x;
}

}  // namespace

void PhotoFrames::PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) {
  if (!new_evaluation_point) return;
  for (std::size_t i = 0; i < photos_.size(); ++i) {
    ceres::AngleAxisToRotationMatrix(photos_[i].data(), frames_[i].photo_from_ground.data());
    frames_[i].left_jacobian = left_jacobian(Eigen::Vector3d(photos_[i].data()));
  }
}

bool AnalyticReprojection::Evaluate(const double* const* parameters, double* residual,
                                    double** jacobians) const {
  const double* c = parameters[0];
  const Eigen::Map<const Eigen::Vector3d> centre(parameters[1] + 3), point(parameters[2]);
  const Eigen::Vector3d q = frame_.photo_from_ground * (point - centre);
  const double over_depth = -1 / q.z();
  const double x = q.x() * over_depth, y = -q.y() * over_depth;
  const double xx = x * x, yy = y * y, xy = x * y, r2 = xx + yy;
  const double k1 = c[geometry::kRadial1], k2 = c[geometry::kRadial2], k3 = c[geometry::kRadial3];
  const double p1 = c[geometry::kTangential1], p2 = c[geometry::kTangential2];
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double xd = x * radial + 2 * p1 * xy + p2 * (r2 + 2 * xx);
  const double yd = y * radial + p1 * (r2 + 2 * yy) + 2 * p2 * xy;
  const double f = c[geometry::kFocalLength], s = c[geometry::kSkew];
  const double ratio = 1 + c[geometry::kAffinity];
  residual[0] = (c[geometry::kPrincipalU] + f * (xd + s * yd) - measured_.x()) * over_sigma_;
  residual[1] = (c[geometry::kPrincipalV] + f * ratio * yd - measured_.y()) * over_sigma_;
  if (jacobians == nullptr) return true;
  const double fu = f * over_sigma_, fv = fu * ratio;
  if (jacobians[0] != nullptr) {
    const double bend_u = r2 + 2 * xx, bend_v = r2 + 2 * yy;
    const double ru = fu * (x + s * y) * r2, rv = fv * y * r2;
    Eigen::Map<RowsByTen> by(jacobians[0]);
    by << (xd + s * yd) * over_sigma_, over_sigma_, 0, 0, fu * yd, ru, ru * r2, ru * r2 * r2,
        fu * (2 * xy + s * bend_v), fu * (bend_u + s * 2 * xy),  //
        ratio * yd * over_sigma_, 0, over_sigma_, fu * yd, 0, rv, rv * r2, rv * r2 * r2,
        fv * bend_v, fv * 2 * xy;
  }
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));
  const double d_xx = radial + slope * xx + 2 * p1 * y + 6 * p2 * x;
  const double d_xy = slope * xy + 2 * p1 * x + 2 * p2 * y;
  const double d_yy = radial + slope * yy + 6 * p1 * y + 2 * p2 * x;
  const double ux = fu * over_depth * (d_xx + s * d_xy), uy = fu * over_depth * (d_xy + s * d_yy);
  const double vx = fv * over_depth * d_xy, vy = fv * over_depth * d_yy;
  RowsByThree by_q;
  by_q << ux, -uy, ux * x + uy * y, vx, -vy, vx * x + vy * y;
  const RowsByThree by_point = by_q * frame_.photo_from_ground;
  if (jacobians[1] != nullptr) {
    // dq = -[q]x J dw.
    RowsByThree turned;
    turned << q.cross(by_q.row(0).transpose()).transpose(),
        q.cross(by_q.row(1).transpose()).transpose();
    Eigen::Map<RowsBySix> by(jacobians[1]);
    by.leftCols<3>() = turned * frame_.left_jacobian;
    by.rightCols<3>() = -by_point;
  }
  if (jacobians[2] != nullptr) {
    Eigen::Map<RowsByThree> by(jacobians[2]);
    by = by_point;
  }
  return true;
}

}  // namespace plumbline::bench
