// SPDX-License-Identifier: MIT
#include "edge/orient/three_point_frame.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/findings/formatted.h"
#include "edge/orient/s_transformation.h"

namespace plumbline::orient {
namespace {

// Sine of the least angle at the origin between the other two.
constexpr double kLeastSine = 0.02;
// Points that are enough to say how well the frame holds all of them.
constexpr std::size_t kMostPoints = 150;

using Matrix3x7 = Eigen::Matrix<double, 3, 7>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

Eigen::Vector3d mean_station(const Solution& solution) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const OrientedPhoto& photo : solution.photos) {
    if (!photo.oriented) continue;
    sum += photo.pose.centre_m;
    ++count;
  }
  return count > 0 ? Eigen::Vector3d(sum / count) : sum;
}

Result<ThreePointFrame> frame_of(const Problem& problem, const Solution& solution,
                                 const FrameRoles& roles) {
  for (const int point : {roles.origin, roles.x_axis, roles.plane}) {
    if (solution.points[at(point)].measured) continue;
    return Error{"The point " + problem.point_names[at(point)] +
                 " of the local frame was not measured: it needs good rays from two photos or "
                 "more. Choose another point in frame.csv."};
  }
  const auto place = [&](int point) { return solution.points[at(point)].in_enu_m; };
  auto frame = three_point_frame(place(roles.origin), place(roles.x_axis), place(roles.plane),
                                 mean_station(solution));
  if (frame) return *frame;
  const auto name = [&](int point) { return problem.point_names[at(point)]; };
  return Error{"The three points of the local frame (" + name(roles.origin) + ", " +
               name(roles.x_axis) + ", " + name(roles.plane) +
               ") lie on (nearly) one line, which makes no plane; choose a third point aside of "
               "the line of the first two in frame.csv."};
}

void move_photos(const ThreePointFrame& frame, Solution& out) {
  for (OrientedPhoto& photo : out.photos) {
    if (!photo.oriented) continue;
    photo.pose.centre_m = frame(photo.pose.centre_m);
    photo.pose.ground_from_photo = frame.turn * photo.pose.ground_from_photo;
    if (photo.gnss_residual_m) photo.gnss_residual_m = frame.turn * *photo.gnss_residual_m;
  }
}

// What is zero by definition is zero to the last bit.
void move_points(const ThreePointFrame& frame, const FrameRoles& roles, Solution& out) {
  for (MeasuredPoint& point : out.points) {
    if (!point.measured) continue;
    point.in_enu_m = frame(point.in_enu_m);
    point.local_covariance_m2 = frame.turn * point.local_covariance_m2 * frame.turn.transpose();
  }
  out.points[at(roles.origin)].in_enu_m.setZero();
  out.points[at(roles.x_axis)].in_enu_m = frame.x_axis;
  out.points[at(roles.plane)].in_enu_m = frame.plane;
}

void state_covariances(const FrameCovariances& covariances, Solution& out) {
  for (std::size_t p = 0; p < out.points.size(); ++p) {
    if (!out.points[p].measured) continue;
    Eigen::Matrix3d& covariance = out.points[p].covariance_m2;
    covariance = covariances.joint({static_cast<int>(p)});
    covariance.diagonal() = covariance.diagonal().cwiseMax(0).eval();
  }
  for (std::size_t i = 0; i < out.photos.size(); ++i) {
    OrientedPhoto& photo = out.photos[i];
    if (!photo.oriented) continue;
    photo.covariance = covariances.of_photo(static_cast<int>(i), photo.covariance);
    photo.covariance.diagonal() = photo.covariance.diagonal().cwiseMax(0).eval();
    const Eigen::Matrix3d by =
        geometry::angles_by_ground_increment(geometry::angles_of(photo.pose.ground_from_photo));
    photo.sigma_omega_phi_kappa_rad =
        (by * photo.covariance.bottomRightCorner<3, 3>() * by.transpose())
            .diagonal()
            .cwiseMax(0)
            .cwiseSqrt();
  }
}

std::vector<int> some_measured(const Solution& solution) {
  std::vector<int> all, some;
  for (std::size_t p = 0; p < solution.points.size(); ++p) {
    if (solution.points[p].measured) all.push_back(static_cast<int>(p));
  }
  const std::size_t step = (all.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

// Covariance of the shift (of the centroid), turn and scale of all points together, as they stand
// in the frame.
Matrix7 common_covariance(const Solution& in_frame) {
  const std::vector<int> points = some_measured(in_frame);
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const int p : points) centroid += in_frame.points[at(p)].in_enu_m / static_cast<double>(n);
  Eigen::MatrixXd design(3 * n, 7);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d from =
        in_frame.points[at(points[static_cast<std::size_t>(i)])].in_enu_m - centroid;
    design.block<3, 7>(3 * i, 0) << Eigen::Matrix3d::Identity(), -geometry::cross_matrix(from),
        from;
  }
  const Matrix7 normal = design.transpose() * design;
  const Eigen::MatrixXd fit = normal.inverse() * design.transpose();
  return fit * in_frame.covariances->joint(points) * fit.transpose();
}

void restate_common(const Options& options, Solution& out) {
  const Matrix7 c = common_covariance(out);
  CommonSigmas& common = out.summary.common;
  common.position_m = std::sqrt(c.diagonal().head<3>().maxCoeff());
  common.tilt_rad = std::sqrt(c.diagonal().segment<2>(3).maxCoeff());
  common.azimuth_rad = std::sqrt(c(5, 5));
  auto& list = out.summary.unobservable;
  std::erase_if(list, [](const Unobservable& u) {
    return u.name == "azimuth" || u.name == "tilt" || u.name == "position" ||
           u.name == "gnss_offset";
  });
  const auto judge = [&](const char* name, const char* what, double sigma_rad, double most_deg) {
    if (!(sigma_rad > most_deg * kRadPerDeg)) return;
    char text[240];
    std::snprintf(text, sizeof text,
                  "The three points of the local frame give the %s of the whole only to %.2g "
                  "degrees (sigma). Choose points further apart, away from the foot of the climb.",
                  what, sigma_rad * kDegPerRad);
    list.push_back({name, text});
  };
  judge("azimuth", "direction", common.azimuth_rad, options.max_azimuth_sigma_deg);
  judge("tilt", "level", common.tilt_rad, options.max_tilt_sigma_deg);
}

// Are all heights together, under their joint covariance, what flat ground would give? Then they
// are no measurement of relief. Chi-square at 95 %, by its normal approximation (Fisher 1922).
void judge_relief(Solution& out) {
  std::vector<int> points = some_measured(out);
  std::erase_if(points, [&](int p) { return !(out.points[at(p)].covariance_m2(2, 2) > 0); });
  const auto n = static_cast<Eigen::Index>(points.size());
  if (n == 0) return;
  const Eigen::MatrixXd joint = out.covariances->joint(points);
  const Eigen::MatrixXd c = joint(Eigen::seqN(2, n, 3), Eigen::seqN(2, n, 3));
  Eigen::VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i)
    z[i] = out.points[at(points[static_cast<std::size_t>(i)])].in_enu_m.z();
  const double chi_square = z.dot(c.ldlt().solve(z));
  const auto dof = static_cast<double>(n);
  constexpr double kNormal95 = 1.645;
  const double limit = 0.5 * std::pow(kNormal95 + std::sqrt(2 * dof - 1), 2);
  const double sigma_m = std::sqrt(c.diagonal().mean());
  // The heights found hold their errors: relief^2 = found^2 - sigma^2, and beats nothing below it.
  const double found_m = std::sqrt(z.squaredNorm() / dof);
  const bool is_flat = chi_square >= 0 && chi_square <= limit;
  const bool is_worse = found_m < std::sqrt(2.0) * sigma_m;
  if (!is_flat && !is_worse) return;
  char text[400];
  std::snprintf(text, sizeof text,
                "The heights do not beat the answer that everything is flat: %s (RMS sigma %.2g m, "
                "RMS height %.2g m). A side-step, or photos from lower down, would show the "
                "relief.",
                is_flat ? formatted("all %d together lie within their error bars of Z = 0",
                                    static_cast<int>(n))
                              .c_str()
                        : "their error bars are as long as the relief is high",
                sigma_m, found_m);
  out.summary.unobservable.push_back({"relief", text});
}

}  // namespace

std::optional<ThreePointFrame> three_point_frame(const Eigen::Vector3d& origin,
                                                 const Eigen::Vector3d& x_axis,
                                                 const Eigen::Vector3d& plane,
                                                 const Eigen::Vector3d& above) {
  const Eigen::Vector3d along = x_axis - origin, across = plane - origin;
  const Eigen::Vector3d normal = along.cross(across);
  const double apart = std::max(along.norm(), across.norm());
  if (!(normal.norm() > kLeastSine * along.norm() * across.norm()) ||
      !(std::min(along.norm(), across.norm()) > 1e-3 * apart)) {
    return std::nullopt;
  }
  const Eigen::Vector3d x = along.normalized();
  const Eigen::Vector3d z = (normal.dot(above - origin) < 0 ? -1 : 1) * normal.normalized();
  ThreePointFrame frame;
  frame.origin = origin;
  frame.turn << x.transpose(), z.cross(x).transpose(), z.transpose();
  frame.x_axis = {along.norm(), 0, 0};
  frame.plane = {across.dot(x), frame.turn.row(1).dot(across), 0};
  return frame;
}

Result<Solution> in_three_point_frame(const Problem& problem, const Solution& solution,
                                      const FrameRoles& roles, const Options& options) {
  const auto frame = frame_of(problem, solution, roles);
  if (!frame) return frame.error();
  Solution out = solution;
  out.frame = roles;
  move_photos(*frame, out);
  move_points(*frame, roles, out);
  const auto covariances =
      std::make_shared<FrameCovariances>(solution.covariances, roles, STransformation(*frame), out);
  state_covariances(*covariances, out);
  out.covariances = covariances;
  restate_common(options, out);
  judge_relief(out);
  return out;
}

}  // namespace plumbline::orient
