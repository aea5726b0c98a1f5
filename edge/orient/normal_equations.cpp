// SPDX-License-Identifier: MIT
#include "edge/orient/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "edge/geometry/rotation.h"

namespace plumbline::orient {
namespace {

using geometry::kInteriorCount;

// Photo-frame point q = R' (P - C). For the increment R <- exp([d]x) R:
// dq = R' (dP - dC) + R' [P - C]x dd; the C of a row moves with line time, not that of the pose.
bool linearise(const Network& network, const Ray& ray, const State& state, RayLinear& out) {
  const geometry::Pose& pose = state.poses[at(ray.slot)];
  const Eigen::Vector3d from_centre = state.points[at(ray.point)] - state.centre_of(ray);
  const Eigen::Matrix3d photo_from_ground = pose.ground_from_photo.transpose();
  const auto projection =
      geometry::project_with_derivatives(state.interior, photo_from_ground * from_centre);
  if (!projection) return false;
  out.active = true;
  const double effect = ray.group == ImageGroup::kTies ? network.ties_design_effect : 1;
  out.information = 1 / (ray.sigma_px * ray.sigma_px * effect);
  out.residual = projection->pixel - ray.pixel;
  out.by_point.noalias() = projection->by_point * photo_from_ground;
  out.by_common.leftCols<kInteriorCount>() = projection->by_interior;
  out.by_common.col(kLineTime) = -out.by_point * ray.centre_by_line_time_m_s;
  out.by_common.col(kDelay).setZero();
  out.by_common.leftCols<kShared>() *= network.shared_mask.asDiagonal();
  out.by_common.middleCols<3>(kShared) = -out.by_point;
  out.by_common.rightCols<3>().noalias() = out.by_point * geometry::cross_matrix(from_centre);
  return true;
}

// Costs as much as a residual of so many sigmas.
constexpr double kUnprojectableSigmas = 1e5;

double robust_cost(double squared_sigmas, double cauchy_scale) {
  if (cauchy_scale == 0) return squared_sigmas;
  const double c2 = cauchy_scale * cauchy_scale;
  return c2 * std::log1p(squared_sigmas / c2);
}

double robust_weight(double squared_sigmas, double cauchy_scale) {
  return cauchy_scale == 0 ? 1 : 1 / (1 + squared_sigmas / (cauchy_scale * cauchy_scale));
}

void add_term(const Term& term, NormalEquations& out) {
  const Eigen::MatrixXd weighted = term.information * term.jacobian;
  const Eigen::MatrixXd n = term.jacobian.transpose() * weighted;
  const Eigen::VectorXd g = weighted.transpose() * term.residual;
  for (Eigen::Index i = 0; i < n.rows(); ++i) {
    const int row = term.columns[static_cast<std::size_t>(i)];
    out.gradient[row] += g[i];
    for (Eigen::Index j = 0; j < n.cols(); ++j) {
      out.n(row, term.columns[static_cast<std::size_t>(j)]) += n(i, j);
    }
  }
}

// The columns that the rays of one point touch: shared, its photos, and itself if it is kept.
std::vector<int> columns_of(const Network& network, int point) {
  std::vector<int> columns(kShared);
  for (int i = 0; i < kShared; ++i) columns[at(i)] = i;
  int last_slot = -1;
  for (int k = network.first_ray[at(point)]; k < network.first_ray[at(point) + 1]; ++k) {
    const Ray& ray = network.rays[at(k)];
    if (!ray.used || ray.slot == last_slot) continue;
    last_slot = ray.slot;
    for (int i = 0; i < Layout::kPose; ++i) columns.push_back(network.layout.photo(ray.slot) + i);
  }
  return columns;
}

void scatter(const std::vector<int>& columns, const Eigen::MatrixXd& block, Eigen::MatrixXd& n) {
  for (Eigen::Index j = 0; j < block.cols(); ++j) {
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      n(columns[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)]) += block(i, j);
    }
  }
}

void put_kept_point(int first_column, const PointBlock& block, NormalEquations& out) {
  out.n.block<3, 3>(first_column, first_column) += block.v;
  out.gradient.segment<3>(first_column) += block.gradient;
  for (Eigen::Index i = 0; i < block.e.rows(); ++i) {
    const int row = block.columns[static_cast<std::size_t>(i)];
    out.n.block<1, 3>(row, first_column) += block.e.row(i);
    out.n.block<3, 1>(first_column, row) += block.e.row(i).transpose();
  }
}

// Sums the rays of one point into its block and into the common part of the system.
void add_point(const Network& network, const std::vector<RayLinear>& rays, int point,
               NormalEquations& out) {
  PointBlock& block = out.points[at(point)];
  block.columns = columns_of(network, point);
  const auto width = static_cast<Eigen::Index>(block.columns.size());
  block.e.setZero(width, 3);
  Eigen::MatrixXd common = Eigen::MatrixXd::Zero(width, width);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(width);
  Eigen::Index photo_at = kShared - Layout::kPose;
  int last_slot = -1;
  for (int k = network.first_ray[at(point)]; k < network.first_ray[at(point) + 1]; ++k) {
    const RayLinear& ray = rays[at(k)];
    if (!network.rays[at(k)].used) continue;
    if (network.rays[at(k)].slot != last_slot) photo_at += Layout::kPose;
    last_slot = network.rays[at(k)].slot;
    if (!ray.active) continue;
    const auto shared = ray.by_common.leftCols<kShared>();
    const auto pose = ray.by_common.rightCols<Layout::kPose>();
    const double w = ray.information;
    common.topLeftCorner<kShared, kShared>() += w * shared.transpose() * shared;
    common.block<kShared, Layout::kPose>(0, photo_at) += w * shared.transpose() * pose;
    common.block<Layout::kPose, Layout::kPose>(photo_at, photo_at) += w * pose.transpose() * pose;
    gradient.head<kShared>() += w * shared.transpose() * ray.residual;
    gradient.segment<Layout::kPose>(photo_at) += w * pose.transpose() * ray.residual;
    block.e.topRows<kShared>() += w * shared.transpose() * ray.by_point;
    block.e.middleRows<Layout::kPose>(photo_at) += w * pose.transpose() * ray.by_point;
    block.v += w * ray.by_point.transpose() * ray.by_point;
    block.gradient += w * ray.by_point.transpose() * ray.residual;
  }
  common.bottomLeftCorner(width - kShared, kShared) =
      common.topRightCorner(kShared, width - kShared).transpose();
  scatter(block.columns, common, out.n);
  for (Eigen::Index i = 0; i < width; ++i) {
    out.gradient[block.columns[static_cast<std::size_t>(i)]] += gradient[i];
  }
  const int kept = network.layout.kept_of_point[at(point)];
  block.active = kept < 0 && width > kShared;
  if (kept >= 0) put_kept_point(network.layout.kept_point(kept), block, out);
}

// Columns that nothing touches (a camera parameter held fixed) stay where they are.
void pin_untouched(Eigen::MatrixXd& n) {
  for (Eigen::Index i = 0; i < n.rows(); ++i) {
    if (n(i, i) == 0) n(i, i) = 1;
  }
}

// Marquardt scaling; a diagonal far below its neighbours' is floored, or damping would not reach
// a direction that the data hardly see.
template <typename Matrix>
void damp(Matrix& m, double lambda) {
  const double floor = 1e-9 * m.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < m.rows(); ++i) m(i, i) += lambda * std::max(m(i, i), floor);
}

Eigen::MatrixXd eliminate(const NormalEquations& equations, double lambda,
                          Eigen::VectorXd* right_side) {
  Eigen::MatrixXd s = equations.n;
  pin_untouched(s);
  for (Eigen::Index i = 0; i < s.rows(); ++i) s(i, i) *= 1 + lambda;
  for (const PointBlock& block : equations.points) {
    if (!block.active) continue;
    Eigen::Matrix3d v = block.v;
    damp(v, lambda);
    const Eigen::Matrix<double, Eigen::Dynamic, 3> y = block.e * v.inverse();
    scatter(block.columns, -y * block.e.transpose(), s);
    if (right_side == nullptr) continue;
    const Eigen::VectorXd g = y * block.gradient;
    for (Eigen::Index i = 0; i < g.size(); ++i) {
      (*right_side)[block.columns[static_cast<std::size_t>(i)]] += g[i];
    }
  }
  return s;
}

}  // namespace

std::optional<Eigen::Vector2d> residual_of(const Ray& ray, const State& state) {
  const geometry::Pose& pose = state.poses[at(ray.slot)];
  const auto pixel =
      geometry::project(state.interior, pose.ground_from_photo.transpose() *
                                            (state.points[at(ray.point)] - state.centre_of(ray)));
  if (!pixel) return std::nullopt;
  return *pixel - ray.pixel;
}

RaysLinear linearise_rays(const Network& network, const State& state, double cauchy_scale) {
  RaysLinear out;
  out.rays.resize(network.rays.size());
  for (std::size_t k = 0; k < out.rays.size(); ++k) {
    if (!network.rays[k].used) continue;
    RayLinear& ray = out.rays[k];
    if (!linearise(network, network.rays[k], state, ray)) {
      out.cost += robust_cost(kUnprojectableSigmas * kUnprojectableSigmas, cauchy_scale);
      continue;
    }
    const double squared_sigmas = ray.residual.squaredNorm() * ray.information;
    out.cost += robust_cost(squared_sigmas, cauchy_scale);
    ray.information *= robust_weight(squared_sigmas, cauchy_scale);
  }
  return out;
}

NormalEquations normal_equations(const Network& network, const std::vector<RayLinear>& rays,
                                 const std::vector<Term>& terms) {
  NormalEquations out;
  const int columns = network.layout.columns();
  out.n.setZero(columns, columns);
  out.gradient.setZero(columns);
  out.points.resize(at(network.points()));
  for (int point = 0; point < network.points(); ++point) add_point(network, rays, point, out);
  for (const Term& term : terms) add_term(term, out);
  return out;
}

Eigen::MatrixXd reduced_matrix(const NormalEquations& equations, double lambda) {
  return eliminate(equations, lambda, nullptr);
}

std::optional<Step> solve(const NormalEquations& equations, double lambda) {
  Eigen::VectorXd right_side = -equations.gradient;
  Eigen::MatrixXd s = eliminate(equations, lambda, &right_side);
  const Eigen::VectorXd scale = s.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-150).cwiseInverse();
  s = scale.asDiagonal() * s * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(s);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Step step;
  step.common = scale.asDiagonal() * factor.solve(scale.asDiagonal() * right_side);
  if (!step.common.allFinite()) return std::nullopt;
  step.points.assign(equations.points.size(), Eigen::Vector3d::Zero());
  for (std::size_t p = 0; p < equations.points.size(); ++p) {
    const PointBlock& block = equations.points[p];
    if (!block.active) continue;
    Eigen::Vector3d g = -block.gradient;
    for (Eigen::Index i = 0; i < block.e.rows(); ++i) {
      g -= block.e.row(i).transpose() * step.common[block.columns[static_cast<std::size_t>(i)]];
    }
    Eigen::Matrix3d v = block.v;
    damp(v, lambda);
    step.points[p] = v.inverse() * g;
    if (!step.points[p].allFinite()) return std::nullopt;
  }
  return step;
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

State moved_by(const Network& network, const State& state, const Step& step) {
  State moved = state;
  const Layout& layout = network.layout;
  const WholeTurn whole(layout, state, step);
  moved.interior += step.common.head<kInteriorCount>();
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
