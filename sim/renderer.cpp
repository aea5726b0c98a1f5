// SPDX-License-Identifier: MIT
#include "sim/renderer.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "edge/base/parallel.h"
#include "sim/picture.h"

namespace plumbline::sim {
namespace {

constexpr int kLattice_px = 4;
constexpr double kSubPixels[2] = {-0.25, 0.25};

// Directions in the photo frame, one per node of a lattice over the photo, (x, y) of (x, y, -1).
class RayLattice {
 public:
  RayLattice(const geometry::Camera& camera, int threads)
      : columns_(camera.width_px / kLattice_px + 3), rows_(camera.height_px / kLattice_px + 3) {
    directions_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                       Eigen::Vector2d::Zero());
    parallel_for(rows_, threads, [&](int j) {
      for (int i = 0; i < columns_; ++i) {
        const auto ray =
            geometry::ray_in_photo(camera.interior, {(i - 1) * kLattice_px, (j - 1) * kLattice_px});
        if (ray) node(i, j) = ray->head<2>();
      }
    });
  }

  int columns() const { return columns_; }

  // The directions of one line of the photo at the lattice's columns.
  Eigen::Vector2d at_column(int i, double v) const {
    const double y = v / kLattice_px + 1;
    const int j = std::clamp(static_cast<int>(y), 0, rows_ - 2);
    const double b = y - j;
    return (1 - b) * node(i, j) + b * node(i, j + 1);
  }

 private:
  Eigen::Vector2d& node(int i, int j) {
    return directions_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(i)];
  }
  const Eigen::Vector2d& node(int i, int j) const {
    return const_cast<RayLattice*>(this)->node(i, j);
  }

  int columns_;
  int rows_;
  std::vector<Eigen::Vector2d> directions_;
};

class LineCaster {
 public:
  LineCaster(const World& world, const geometry::Camera& camera, const geometry::Pose& pose,
             const RayLattice& lattice)
      : world_(world), camera_(camera), pose_(pose), lattice_(lattice) {}

  // Adds one line of samples at height `v` to a row of the picture.
  void cast(double v, float* row) const {
    const std::vector<Eigen::Vector2d> ground = ground_directions(v);
    double height_m = 0;
    for (int u = 0; u < camera_.width_px; ++u) {
      const Footprint footprint(
          std::max(0.5 * (pose_.centre_m.z() - height_m) / camera_.interior[0], 1e-4));
      for (const double sub : kSubPixels) {
        const double x = (u + sub) / kLattice_px + 1;
        const auto i = static_cast<std::size_t>(x);
        const double a = x - static_cast<double>(i);
        const Eigen::Vector2d per_metre = (1 - a) * ground[i] + a * ground[i + 1];
        const Eigen::Vector3f colour = sample(per_metre, footprint, height_m);
        for (int c = 0; c < 3; ++c) row[3 * u + c] += 0.25f * colour[c];
      }
    }
  }

 private:
  // Metres east and north per metre of height.
  std::vector<Eigen::Vector2d> ground_directions(double v) const {
    std::vector<Eigen::Vector2d> directions;
    for (int i = 0; i < lattice_.columns(); ++i) {
      const Eigen::Vector2d in_photo = lattice_.at_column(i, v);
      const Eigen::Vector3d ray =
          pose_.ground_from_photo * Eigen::Vector3d(in_photo.x(), in_photo.y(), -1);
      directions.push_back(ray.head<2>() / std::min(ray.z(), -0.05));
    }
    return directions;
  }

  Eigen::Vector3f sample(const Eigen::Vector2d& per_metre, const Footprint& footprint,
                         double& height_m) const {
    const Eigen::Vector3d& centre_m = pose_.centre_m;
    const Eigen::Vector2d at_zero_m = centre_m.head<2>() - centre_m.z() * per_metre;
    height_m = world_.terrain().meet({at_zero_m.x(), at_zero_m.y(), per_metre.x(), per_metre.y()},
                                     height_m);
    return world_.colour(at_zero_m.x() + height_m * per_metre.x(),
                         at_zero_m.y() + height_m * per_metre.y(), footprint);
  }

  const World& world_;
  const geometry::Camera& camera_;
  const geometry::Pose& pose_;
  const RayLattice& lattice_;
};

}  // namespace

Image render(const World& world, const geometry::Camera& camera, const geometry::Pose& pose,
             const SensorOptions& sensor, std::uint64_t seed, int threads) {
  const RayLattice lattice(camera, threads);
  const LineCaster caster(world, camera, pose, lattice);
  Picture picture{camera.width_px, camera.height_px, {}};
  picture.light.assign(
      3 * static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px),
      0.0f);
  parallel_for(camera.height_px, threads, [&](int v) {
    for (const double sub : kSubPixels) caster.cast(v + sub, picture.row(v));
  });
  return develop(std::move(picture), sensor, seed, threads);
}

}  // namespace plumbline::sim
