// SPDX-License-Identifier: MIT
#include "edge/orient/paper/coplanarity.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace plumbline::orient::paper {
namespace {

// A ray (x, y, -1) and how x, y move with pixel and camera: the inverse of the projection's
// derivatives (eq. 4 maps the other way than a lens does).
struct ImageRay {
  Eigen::Vector3d direction;
  Eigen::Matrix2d by_pixel;
  Eigen::Matrix<double, 2, geometry::kInteriorCount> by_interior;
};

std::optional<ImageRay> ray_of(const geometry::InteriorVector& interior,
                               const Eigen::Vector2d& pixel) {
  const auto direction = geometry::ray_in_photo(interior, pixel);
  if (!direction) return std::nullopt;
  const auto projection = geometry::project_with_derivatives(interior, *direction);
  if (!projection) return std::nullopt;
  ImageRay ray;
  ray.direction = *direction;
  ray.by_pixel = projection->by_point.leftCols<2>().inverse();
  ray.by_interior = -ray.by_pixel * projection->by_interior;
  return ray;
}

}  // namespace

std::optional<Coplanarity> coplanarity(const geometry::InteriorVector& interior,
                                       const geometry::Pose& pose, const PairObservation& seen) {
  const auto ray_1 = ray_of(interior, seen.pixel_1), ray_i = ray_of(interior, seen.pixel_i);
  if (!ray_1 || !ray_i) return std::nullopt;
  const Eigen::Vector3d& base = pose.centre_m;
  const Eigen::Vector3d turned = pose.ground_from_photo * ray_i->direction;
  const Eigen::Vector3d normal_1 = turned.cross(base);
  const Eigen::Vector3d normal_i = base.cross(ray_1->direction);
  const Eigen::RowVector2d by_xy_1 = normal_1.head<2>().transpose();
  const Eigen::RowVector2d by_xy_i =
      (pose.ground_from_photo.transpose() * normal_i).head<2>().transpose();
  const double noise_1 = (by_xy_1 * ray_1->by_pixel).norm();
  const double noise_i = (by_xy_i * ray_i->by_pixel).norm();
  const double weight = 1 / std::hypot(seen.sigma_1_px * noise_1, seen.sigma_i_px * noise_i);
  const double determinant = base.dot(ray_1->direction.cross(turned));
  Coplanarity out;
  if (!std::isfinite(weight)) return std::nullopt;
  out.residual = weight * determinant;
  out.sampson_px = determinant / std::hypot(noise_1, noise_i);
  out.by_interior = weight * (by_xy_1 * ray_1->by_interior + by_xy_i * ray_i->by_interior);
  out.by_rotation = weight * turned.cross(normal_i).transpose();
  out.by_base = weight * ray_1->direction.cross(turned).transpose();
  return out;
}

}  // namespace plumbline::orient::paper
