// SPDX-License-Identifier: MIT
#include "tests/accuracy/bound.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "edge/base/index.h"
#include "edge/geometry/rotation.h"

namespace plumbline::accuracy {
namespace {

using geometry::kInteriorCount;
using orient::testing::MadeFlight;

constexpr int kPose = 6;
constexpr int kOwn = kInteriorCount + kPose;  // of one ray, besides its point
// What holds a target that has no rays, or a datum that nothing fixes: next to nothing.
constexpr double kNothing = 1e-5;
constexpr double kOwnHeadingShare = 0.2;
constexpr double kLeastSigmaM = 1e-4;  // stations and control are never taken as better

struct RayDerivatives {
  Eigen::Matrix<double, 2, kOwn> by_common;
  Eigen::Matrix<double, 2, 3> by_point;
};

// A ray with one of its 19 unknowns moved by `by`.
Eigen::Vector2d pixel(const MadeFlight& flight, int photo, int point, int unknown, double by) {
  geometry::InteriorVector interior = flight.interior;
  geometry::Pose pose = flight.poses[at(photo)];
  Eigen::Vector3d target = flight.points[at(point)];
  if (unknown < kInteriorCount) {
    interior[unknown] += by;
  } else if (unknown < kInteriorCount + 3) {
    pose.centre_m[unknown - kInteriorCount] += by;
  } else if (unknown < kOwn) {
    const Eigen::Vector3d turn = by * Eigen::Vector3d::Unit(unknown - kInteriorCount - 3);
    pose.ground_from_photo = geometry::rotation_by(turn) * pose.ground_from_photo;
  } else {
    target[unknown - kOwn] += by;
  }
  return geometry::project(interior, pose.ground_from_photo.transpose() * (target - pose.centre_m))
      .value_or(Eigen::Vector2d::Zero());
}

RayDerivatives derivatives(const MadeFlight& flight, int photo, int point) {
  RayDerivatives out;
  for (int k = 0; k < kOwn + 3; ++k) {
    const double h = k < 3                    ? 1e-2
                     : k < kInteriorCount     ? 1e-5
                     : k < kInteriorCount + 3 ? 1e-3
                                              : 1e-5;
    const double step = k >= kOwn ? 1e-3 : h;
    const Eigen::Vector2d slope =
        (pixel(flight, photo, point, k, step) - pixel(flight, photo, point, k, -step)) / (2 * step);
    if (k < kOwn) {
      out.by_common.col(k) = slope;
    } else {
      out.by_point.col(k - kOwn) = slope;
    }
  }
  return out;
}

// Columns: interior, photos, targets; ties are eliminated as they come.
class Information {
 public:
  Information(const MadeFlight& flight, double tilt_sigma_rad)
      : flight_(flight), photos_(static_cast<int>(flight.poses.size())) {
    const int columns = target(flight.targets);
    n_ = kNothing * Eigen::MatrixXd::Identity(columns, columns);
    add_rays();
    add_camera();
    add_tilts(tilt_sigma_rad);
    add_stations();
    add_headings();
    add_lengths_and_control();
  }

  std::optional<Bound> inverse() const {
    std::vector<int> adjusted;
    for (int i = 0; i < n_.rows(); ++i) {
      if (i >= kInteriorCount || flight_.problem.camera.sigma[i] > 0) adjusted.push_back(i);
    }
    const Eigen::MatrixXd n = n_(adjusted, adjusted);
    const Eigen::VectorXd scale = n.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> factor(scale.asDiagonal() * n * scale.asDiagonal());
    if (factor.info() != Eigen::Success || !factor.isPositive()) return std::nullopt;
    const Eigen::MatrixXd unscaled = factor.solve(Eigen::MatrixXd::Identity(n.rows(), n.rows()));
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n_.rows(), n_.rows());
    covariance(adjusted, adjusted) = scale.asDiagonal() * unscaled * scale.asDiagonal();
    const int first = target(0), size = 3 * flight_.targets;
    return Bound{covariance.block(first, first, size, size), covariance.topLeftCorner(first, first),
                 defined_};
  }

 private:
  static int photo(int index) { return kInteriorCount + kPose * index; }
  int target(int index) const { return photo(photos_) + 3 * index; }

  void add_rays() {
    std::vector<std::vector<int>> seen(flight_.points.size());
    const auto& observations = flight_.problem.observations;
    for (std::size_t k = 0; k < observations.size(); ++k) {
      if (!flight_.gross[k]) seen[at(observations[k].point)].push_back(static_cast<int>(k));
    }
    for (int p = 0; p < static_cast<int>(seen.size()); ++p) {
      if (p < flight_.targets) defined_.push_back(seen[at(p)].size() >= 2);
      if (seen[at(p)].size() >= 2) add_point(p, seen[at(p)]);
    }
  }

  void add_point(int point, const std::vector<int>& rays) {
    const bool own = point < flight_.targets;
    const int columns = photo(photos_);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * rays.size()), columns);
    Eigen::MatrixXd b(a.rows(), 3);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const orient::Observation& seen = flight_.problem.observations[at(rays[k])];
      const RayDerivatives ray = derivatives(flight_, seen.photo, point);
      const auto row = static_cast<Eigen::Index>(2 * k);
      a.block<2, kInteriorCount>(row, 0) = ray.by_common.leftCols<kInteriorCount>() / seen.sigma_px;
      a.block<2, kPose>(row, photo(seen.photo)) = ray.by_common.rightCols<kPose>() / seen.sigma_px;
      b.middleRows<2>(row) = ray.by_point / seen.sigma_px;
    }
    n_.topLeftCorner(columns, columns).noalias() += a.transpose() * a;
    const Eigen::MatrixXd e = a.transpose() * b;
    const Eigen::Matrix3d v = b.transpose() * b;
    if (own) {
      n_.block(0, target(point), columns, 3) += e;
      n_.block(target(point), 0, 3, columns) += e.transpose();
      n_.block<3, 3>(target(point), target(point)) += v;
    } else {
      n_.topLeftCorner(columns, columns).noalias() -= e * v.inverse() * e.transpose();
    }
  }

  void add_camera() {
    for (int i = 0; i < kInteriorCount; ++i) {
      const double sigma = flight_.problem.camera.sigma[i];
      if (sigma > 0 && std::isfinite(sigma)) n_(i, i) += 1 / (sigma * sigma);
    }
  }

  // Near the vertical omega and phi are turns about east and north, to second order.
  void add_tilts(double sigma_rad) {
    for (int i = 0; i < photos_; ++i) {
      n_.diagonal().segment<2>(photo(i) + 3).array() += 1 / (sigma_rad * sigma_rad);
    }
  }

  void add_stations() {
    const auto& problem = flight_.problem;
    if (!problem.photos.front().station) return;
    const orient::GnssErrorModel& gnss = problem.gnss;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3 * photos_, 3 * photos_);
    for (int i = 0; i < photos_; ++i) {
      for (int j = 0; j < photos_; ++j) {
        const double apart_s = *problem.photos[at(i)].time_s - *problem.photos[at(j)].time_s;
        const double alike =
            gnss.correlation_s > 0 ? std::exp(-std::abs(apart_s) / gnss.correlation_s) : 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double offset =
              axis < 2 ? gnss.offset_sigma_horizontal_m : gnss.offset_sigma_vertical_m;
          const double drift =
              axis < 2 ? gnss.correlated_sigma_horizontal_m : gnss.correlated_sigma_vertical_m;
          covariance(3 * i + axis, 3 * j + axis) = offset * offset + alike * drift * drift;
        }
      }
      covariance.block<3, 3>(3 * i, 3 * i) += problem.photos[at(i)].station->covariance_m2;
    }
    const Eigen::MatrixXd information = covariance.inverse();
    for (int i = 0; i < photos_; ++i) {
      for (int j = 0; j < photos_; ++j) {
        n_.block<3, 3>(photo(i), photo(j)) += information.block<3, 3>(3 * i, 3 * j);
      }
    }
  }

  // kappa about the vertical, to first order in the tilts.
  void add_headings() {
    if (!flight_.problem.photos.front().heading) return;
    const double sigma = flight_.problem.photos.front().heading->sigma_rad;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(photos_, photos_, sigma * sigma);
    covariance.diagonal().array() += std::pow(kOwnHeadingShare * sigma, 2);
    const Eigen::MatrixXd information = covariance.inverse();
    for (int i = 0; i < photos_; ++i) {
      for (int j = 0; j < photos_; ++j) n_(photo(i) + 5, photo(j) + 5) += information(i, j);
    }
  }

  void add_lengths_and_control() {
    for (const orient::Length& length : flight_.problem.lengths) {
      const Eigen::Vector3d along =
          (flight_.points[at(length.point_b)] - flight_.points[at(length.point_a)]).normalized();
      Eigen::VectorXd row = Eigen::VectorXd::Zero(n_.rows());
      row.segment<3>(target(length.point_a)) = -along / length.sigma_m;
      row.segment<3>(target(length.point_b)) = along / length.sigma_m;
      n_ += row * row.transpose();
    }
    for (const orient::Control& control : flight_.problem.control) {
      const Eigen::Matrix3d floor = kLeastSigmaM * kLeastSigmaM * Eigen::Matrix3d::Identity();
      n_.block<3, 3>(target(control.point), target(control.point)) +=
          (control.covariance_m2 + floor).inverse();
    }
  }

  const MadeFlight& flight_;
  int photos_;
  Eigen::MatrixXd n_;
  std::vector<bool> defined_;
};

}  // namespace

std::optional<Bound> bound_of(const MadeFlight& flight, double tilt_sigma_rad) {
  return Information(flight, tilt_sigma_rad).inverse();
}

}  // namespace plumbline::accuracy
