// SPDX-License-Identifier: MIT
#include "edge/orient/paper/intersection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "edge/base/index.h"
#include "edge/base/units.h"

namespace plumbline::orient::paper {
namespace {

constexpr int kMaxIntersections = 100;
constexpr double kIntersectionTolerance = 1e-12;
constexpr double kMostDamping = 1e10;
// Of the plane's height below photo 1, as eq. 1 has it.
constexpr double kHeightShare = 0.1;

struct Ground {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // Z = p0 + p1 X + p2 Y
};

// A point's block of the normal equations, with the plane's columns at its side.
struct Block {
  Eigen::Matrix3d v = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d e = Eigen::Matrix3d::Zero();  // point by plane
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

struct IntersectionEquations {
  std::vector<Block> blocks;
  Eigen::Matrix3d plane = Eigen::Matrix3d::Zero();
  Eigen::Vector3d plane_gradient = Eigen::Vector3d::Zero();
  double cost = 0;
  double squares_px2 = 0;
  int rays = 0;
  bool whole = true;  // false: a point is not in front of its photo
};

class Intersector {
 public:
  Intersector(const Problem& problem, const Heights& heights, const RelativeOrientation& relative,
              const Priors& priors)
      : problem_(problem),
        relative_(relative),
        flat_m_(priors.ground_flat_m),
        height_m_(heights.height_m[at(heights.lowest)]),
        slope_(std::tan(priors.tilt_deg * kRadPerDeg)) {}

  // Each point where its first ray meets the level plane at the height of eq. 1.
  std::optional<Ground> start() const {
    Ground ground;
    ground.plane = {-height_m_, 0, 0};
    ground.points.assign(problem_.point_names.size(), Eigen::Vector3d(0, 0, -height_m_));
    std::vector<bool> known(ground.points.size(), false);
    for (const Observation& o : problem_.observations) {
      if (known[at(o.point)]) continue;
      const auto ray = geometry::ray_in_photo(relative_.interior, o.pixel);
      if (!ray) return std::nullopt;
      const geometry::Pose& pose = relative_.poses[at(o.photo)];
      const Eigen::Vector3d along = pose.ground_from_photo * *ray;
      if (!(along.z() < 0)) return std::nullopt;
      const double reach = (-height_m_ - pose.centre_m.z()) / along.z();
      ground.points[at(o.point)] = pose.centre_m + reach * along;
      known[at(o.point)] = true;
    }
    return ground;
  }

  IntersectionEquations linearise(const Ground& ground) const {
    IntersectionEquations out;
    out.blocks.resize(ground.points.size());
    for (const Observation& o : problem_.observations) add_ray(ground, o, out);
    for (std::size_t p = 0; p < ground.points.size(); ++p) add_flatness(ground, p, out);
    const Eigen::Vector3d from(ground.plane[0] + height_m_, ground.plane[1], ground.plane[2]);
    const double height_sigma = kHeightShare * height_m_;
    const Eigen::Vector3d weight =
        Eigen::Vector3d(height_sigma, slope_, slope_).cwiseAbs2().cwiseInverse();
    out.plane += weight.asDiagonal();
    out.plane_gradient += weight.cwiseProduct(from);
    out.cost += from.dot(weight.cwiseProduct(from));
    return out;
  }

  // The points are eliminated (Schur complement over 3 x 3 blocks).
  static Ground moved(const Ground& from, const IntersectionEquations& linear, double lambda) {
    Eigen::Matrix3d reduced = linear.plane;
    reduced.diagonal() *= 1 + lambda;
    Eigen::Vector3d gradient = linear.plane_gradient;
    std::vector<Eigen::Matrix3d> inverses;
    for (const Block& block : linear.blocks) {
      Eigen::Matrix3d damped = block.v;
      damped.diagonal() *= 1 + lambda;
      inverses.push_back(damped.ldlt().solve(Eigen::Matrix3d::Identity()));
      reduced -= block.e.transpose() * inverses.back() * block.e;
      gradient -= block.e.transpose() * inverses.back() * block.gradient;
    }
    const Eigen::Vector3d step = -reduced.ldlt().solve(gradient);
    Ground to = from;
    to.plane += step;
    for (std::size_t p = 0; p < to.points.size(); ++p) {
      const Block& block = linear.blocks[p];
      to.points[p] -= inverses[p] * (block.gradient + block.e * step);
    }
    return to;
  }

 private:
  // Eq. 5: the photo sees R' (P - O).
  void add_ray(const Ground& ground, const Observation& o, IntersectionEquations& out) const {
    const geometry::Pose& pose = relative_.poses[at(o.photo)];
    const Eigen::Matrix3d photo_from_ground = pose.ground_from_photo.transpose();
    const auto seen = geometry::project_with_derivatives(
        relative_.interior, photo_from_ground * (ground.points[at(o.point)] - pose.centre_m));
    if (!seen) {
      out.whole = false;
      return;
    }
    const Eigen::Vector2d residual = seen->pixel - o.pixel;
    const Eigen::Matrix<double, 2, 3> by_point = seen->by_point * photo_from_ground;
    const double weight = 1 / (o.sigma_px * o.sigma_px);
    Block& block = out.blocks[at(o.point)];
    block.v += weight * by_point.transpose() * by_point;
    block.gradient += weight * by_point.transpose() * residual;
    out.cost += weight * residual.squaredNorm();
    out.squares_px2 += residual.squaredNorm();
    ++out.rays;
  }

  void add_flatness(const Ground& ground, std::size_t p, IntersectionEquations& out) const {
    const Eigen::Vector3d& point = ground.points[p];
    const Eigen::Vector3d by_point(-ground.plane[1], -ground.plane[2], 1);
    const Eigen::Vector3d by_plane(-1, -point.x(), -point.y());
    const double weight = 1 / (flat_m_ * flat_m_);
    const double above = point.z() + ground.plane.dot(by_plane);
    out.blocks[p].v += weight * by_point * by_point.transpose();
    out.blocks[p].e += weight * by_point * by_plane.transpose();
    out.blocks[p].gradient += weight * above * by_point;
    out.plane += weight * by_plane * by_plane.transpose();
    out.plane_gradient += weight * above * by_plane;
    out.cost += weight * above * above;
  }

  const Problem& problem_;
  const RelativeOrientation& relative_;
  double flat_m_;
  double height_m_;
  double slope_;
};

}  // namespace

Result<Intersection> intersect(const Problem& problem, const Heights& heights,
                               const RelativeOrientation& relative, const Priors& priors) {
  const Error behind{
      "The relative orientation puts a point behind a photo, so its rays do not meet: are the "
      "observations those of one field, seen from above?"};
  const Intersector intersector(problem, heights, relative, priors);
  auto ground = intersector.start();
  if (!ground) return behind;
  IntersectionEquations here = intersector.linearise(*ground);
  if (!here.whole) return behind;
  Intersection out;
  double lambda = 1e-6;
  while (!out.converged && out.iterations < kMaxIntersections && lambda < kMostDamping) {
    ++out.iterations;
    const Ground trial = Intersector::moved(*ground, here, lambda);
    const IntersectionEquations there = intersector.linearise(trial);
    const bool better = there.whole && there.cost < here.cost;
    out.converged =
        there.whole && std::abs(here.cost - there.cost) <= kIntersectionTolerance * (1 + here.cost);
    lambda = better ? lambda / 8 : 8 * lambda;
    if (!better) continue;
    ground = trial;
    here = there;
  }
  out.points = ground->points;
  out.plane = ground->plane;
  out.rms_px = std::sqrt(here.squares_px2 / std::max(here.rays, 1));
  return out;
}

}  // namespace plumbline::orient::paper
