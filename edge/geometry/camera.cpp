// SPDX-License-Identifier: MIT
#include "edge/geometry/camera.h"

#include <Eigen/LU>
#include <cmath>

namespace plumbline::geometry {
namespace {

// Ideal image-plane coordinates x = X / -Z (right), y = -Y / -Z (down), the quantities that
// distort, and the polynomial of the radial distortion.
struct Ideal {
  double x = 0, y = 0, r2 = 0;
};

double radial_factor(const InteriorVector& c, double r2) {
  return 1 + r2 * (c[kRadial1] + r2 * (c[kRadial2] + r2 * c[kRadial3]));
}

double radial_factor_by_r2(const InteriorVector& c, double r2) {
  return c[kRadial1] + r2 * (2 * c[kRadial2] + r2 * 3 * c[kRadial3]);
}

// The distorted radius r (1 + k1 r2 + ...) must grow with r all the way out to the point, or two
// directions would fall on one pixel. Checked at four radii, enough for a cubic in r2.
bool folds_back(const InteriorVector& c, double r2) {
  for (const double fraction : {0.25, 0.5, 0.75, 1.0}) {
    const double q = fraction * r2;
    if (radial_factor(c, q) + 2 * q * radial_factor_by_r2(c, q) <= 0) return true;
  }
  return false;
}

Eigen::Vector2d distort(const InteriorVector& c, const Ideal& p) {
  const double radial = radial_factor(c, p.r2);
  const double p1 = c[kTangential1], p2 = c[kTangential2];
  return {p.x * radial + 2 * p1 * p.x * p.y + p2 * (p.r2 + 2 * p.x * p.x),
          p.y * radial + p1 * (p.r2 + 2 * p.y * p.y) + 2 * p2 * p.x * p.y};
}

Eigen::Matrix2d distort_by_ideal(const InteriorVector& c, const Ideal& p) {
  const double radial = radial_factor(c, p.r2);
  const double slope = 2 * radial_factor_by_r2(c, p.r2);
  const double p1 = c[kTangential1], p2 = c[kTangential2];
  Eigen::Matrix2d d;
  d(0, 0) = radial + slope * p.x * p.x + 2 * p1 * p.y + 6 * p2 * p.x;
  d(0, 1) = slope * p.x * p.y + 2 * p1 * p.x + 2 * p2 * p.y;
  d(1, 0) = d(0, 1);
  d(1, 1) = radial + slope * p.y * p.y + 6 * p1 * p.y + 2 * p2 * p.x;
  return d;
}

// (f, f (1 + affinity), skew): distorted plane coordinates to pixels.
Eigen::Matrix2d pixel_by_distorted(const InteriorVector& c) {
  Eigen::Matrix2d m;
  m << c[kFocalLength], c[kFocalLength] * c[kSkew], 0, c[kFocalLength] * (1 + c[kAffinity]);
  return m;
}

Eigen::Vector2d principal_point(const InteriorVector& c) {
  return {c[kPrincipalU], c[kPrincipalV]};
}

std::optional<Ideal> ideal_of(const InteriorVector& c, const Eigen::Vector3d& point) {
  const double depth = -point.z();
  if (!(depth > 0)) return std::nullopt;
  Ideal p{point.x() / depth, -point.y() / depth, 0};
  p.r2 = p.x * p.x + p.y * p.y;
  if (!std::isfinite(p.r2) || folds_back(c, p.r2)) return std::nullopt;
  return p;
}

Eigen::Matrix<double, 2, kInteriorCount> pixel_by_interior(const InteriorVector& c, const Ideal& p,
                                                           const Eigen::Vector2d& distorted,
                                                           const Eigen::Matrix2d& to_pixel) {
  const double r4 = p.r2 * p.r2;
  const Eigen::Vector2d ideal(p.x, p.y);
  Eigen::Matrix<double, 2, kInteriorCount> d;
  d.col(kFocalLength) << distorted.x() + c[kSkew] * distorted.y(),
      (1 + c[kAffinity]) * distorted.y();
  d.col(kPrincipalU) << 1, 0;
  d.col(kPrincipalV) << 0, 1;
  d.col(kAffinity) << 0, c[kFocalLength] * distorted.y();
  d.col(kSkew) << c[kFocalLength] * distorted.y(), 0;
  d.col(kRadial1) = to_pixel * ideal * p.r2;
  d.col(kRadial2) = to_pixel * ideal * r4;
  d.col(kRadial3) = to_pixel * ideal * (r4 * p.r2);
  d.col(kTangential1) = to_pixel * Eigen::Vector2d(2 * p.x * p.y, p.r2 + 2 * p.y * p.y);
  d.col(kTangential2) = to_pixel * Eigen::Vector2d(p.r2 + 2 * p.x * p.x, 2 * p.x * p.y);
  return d;
}

}  // namespace

std::optional<Eigen::Vector2d> project(const InteriorVector& interior,
                                       const Eigen::Vector3d& point_in_photo) {
  const auto ideal = ideal_of(interior, point_in_photo);
  if (!ideal) return std::nullopt;
  return principal_point(interior) + pixel_by_distorted(interior) * distort(interior, *ideal);
}

std::optional<Projection> project_with_derivatives(const InteriorVector& interior,
                                                   const Eigen::Vector3d& point_in_photo) {
  const auto ideal = ideal_of(interior, point_in_photo);
  if (!ideal) return std::nullopt;
  const Eigen::Vector2d distorted = distort(interior, *ideal);
  const Eigen::Matrix2d to_pixel = pixel_by_distorted(interior);
  const double depth = -point_in_photo.z();
  Eigen::Matrix<double, 2, 3> ideal_by_point;
  ideal_by_point << 1 / depth, 0, ideal->x / depth, 0, -1 / depth, ideal->y / depth;
  return Projection{principal_point(interior) + to_pixel * distorted,
                    to_pixel * distort_by_ideal(interior, *ideal) * ideal_by_point,
                    pixel_by_interior(interior, *ideal, distorted, to_pixel)};
}

std::optional<Eigen::Vector3d> ray_in_photo(const InteriorVector& interior,
                                            const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d distorted =
      pixel_by_distorted(interior).inverse() * (pixel - principal_point(interior));
  Eigen::Vector2d ideal = distorted;
  constexpr int kMaxNewtonSteps = 30;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const Ideal p{ideal.x(), ideal.y(), ideal.squaredNorm()};
    if (!std::isfinite(p.r2) || folds_back(interior, p.r2)) return std::nullopt;
    const Eigen::Vector2d miss = distort(interior, p) - distorted;
    if (miss.norm() < 1e-14 * (1 + distorted.norm())) break;
    ideal -= distort_by_ideal(interior, p).inverse() * miss;
    if (step + 1 == kMaxNewtonSteps && miss.norm() > 1e-12) return std::nullopt;
  }
  return Eigen::Vector3d(ideal.x(), -ideal.y(), -1);
}

}  // namespace plumbline::geometry
