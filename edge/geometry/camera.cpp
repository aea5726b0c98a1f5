// SPDX-License-Identifier: MIT
#include "edge/geometry/camera.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "edge/base/index.h"
#include "edge/geometry/brown.h"

namespace plumbline::geometry {
namespace {

// The distorted radius r (1 + k1 r2 + ...) must grow with r all the way out to the point, or two
// directions would fall on one pixel. Checked at four radii, enough for a cubic in r2.
bool folds_back(const InteriorVector& c, double r2) {
  for (const double fraction : {0.25, 0.5, 0.75, 1.0}) {
    if (radial_growth(c, fraction * r2) <= 0) return true;
  }
  return false;
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

std::optional<Distorted<double>> distorted_at(const InteriorVector& c,
                                              const Eigen::Vector3d& point) {
  const double depth = -point.z();
  if (!(depth > 0)) return std::nullopt;
  const auto d = distorted(c, point.x() / depth, -point.y() / depth);
  if (!std::isfinite(d.r2) || folds_back(c, d.r2)) return std::nullopt;
  return d;
}

Eigen::Vector2d pixel_of(const InteriorVector& c, const Distorted<double>& d) {
  return {pixel_u(c, d), pixel_v(c, d)};
}

Eigen::Matrix2d matrix_of(const DistortedByIdeal<double>& by) {
  return (Eigen::Matrix2d() << by.xx, by.xy, by.xy, by.yy).finished();
}

}  // namespace

std::optional<Eigen::Vector2d> project(const InteriorVector& interior,
                                       const Eigen::Vector3d& point_in_photo) {
  const auto d = distorted_at(interior, point_in_photo);
  if (!d) return std::nullopt;
  return pixel_of(interior, *d);
}

std::optional<Projection> project_with_derivatives(const InteriorVector& interior,
                                                   const Eigen::Vector3d& point_in_photo) {
  const auto d = distorted_at(interior, point_in_photo);
  if (!d) return std::nullopt;
  std::array<ByPixel<double>, 3> by_point;
  std::array<ByPixel<double>, kInteriorCount> by_interior;
  pixel_by_point(interior, *d, 1 / -point_in_photo.z(), 1.0, by_point.data());
  pixel_by_interior(interior, *d, 1.0, by_interior.data());
  Projection out;
  out.pixel = pixel_of(interior, *d);
  for (int i = 0; i < 3; ++i) out.by_point.col(i) << by_point[at(i)].u, by_point[at(i)].v;
  for (int i = 0; i < kInteriorCount; ++i) {
    out.by_interior.col(i) << by_interior[at(i)].u, by_interior[at(i)].v;
  }
  return out;
}

std::optional<Eigen::Vector3d> ray_in_photo(const InteriorVector& interior,
                                            const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d distorted =
      pixel_by_distorted(interior).inverse() * (pixel - principal_point(interior));
  Eigen::Vector2d ideal = distorted;
  constexpr int kMaxNewtonSteps = 30;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const auto d = geometry::distorted(interior, ideal.x(), ideal.y());
    if (!std::isfinite(d.r2) || folds_back(interior, d.r2)) return std::nullopt;
    const Eigen::Vector2d miss = Eigen::Vector2d(d.x_bent, d.y_bent) - distorted;
    if (miss.norm() < 1e-14 * (1 + distorted.norm())) break;
    ideal -= matrix_of(distorted_by_ideal(interior, d)).inverse() * miss;
    if (step + 1 == kMaxNewtonSteps && miss.norm() > 1e-12) return std::nullopt;
  }
  return Eigen::Vector3d(ideal.x(), -ideal.y(), -1);
}

}  // namespace plumbline::geometry
