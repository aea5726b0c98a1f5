// SPDX-License-Identifier: MIT
#include "edge/orient/network/rays.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "edge/base/median.h"

namespace plumbline::orient {
namespace {

constexpr double kWildHeight = 0.4;  // of the flying height, above or below the ground
constexpr double kAtCamera = 0.05;   // of the flying height

// Where a ray meets the horizontal plane z = height.
std::optional<Eigen::Vector3d> on_plane(const Ray& ray, const State& state, double height) {
  const geometry::Pose& pose = state.poses[at(ray.slot)];
  const auto direction = geometry::ray_in_photo(state.interior, ray.pixel);
  if (!direction) return std::nullopt;
  const Eigen::Vector3d in_ground = pose.ground_from_photo * *direction;
  if (!(in_ground.z() < 0)) return std::nullopt;
  const Eigen::Vector3d centre = state.centre_of(ray);
  return centre + in_ground * ((height - centre.z()) / in_ground.z());
}

bool holds_with_one_ray(const Network& network, int point) {
  return std::any_of(network.problem->control.begin(), network.problem->control.end(),
                     [&](const Control& c) { return c.point == point; });
}

// A point that lost rays must keep three, and more than half: two rays always meet somewhere, and
// what meets by chance meets far from the ground.
bool holds_together(const Network& network, int point, std::ptrdiff_t good, int given) {
  if (network.undetermined[at(point)]) return false;
  if (holds_with_one_ray(network, point)) return good >= 1;
  return good >= 2 && (good == given || (good >= 3 && 2 * good > given));
}

// A point of a known length that has no rays has nothing else to hold it: it stands aside, and the
// length with it, until its rays come back.
void couple(Network& network, int point, bool measured) {
  const std::vector<int>& kept = network.layout.kept;
  const auto place = std::find(kept.begin(), kept.end(), point);
  if (place == kept.end()) return;
  const bool held = measured || holds_with_one_ray(network, point);
  network.layout.kept_of_point[at(point)] = held ? static_cast<int>(place - kept.begin()) : -1;
}

// Points further above or below the ground than a share of the flying height.
void replant_points_beyond(double share, const Network& network, State& state) {
  std::vector<double> heights, stations;
  for (int p = 0; p < network.points(); ++p) {
    if (used_rays(network, p) > 0) heights.push_back(state.points[at(p)].z());
  }
  for (const geometry::Pose& pose : state.poses) stations.push_back(pose.centre_m.z());
  if (heights.empty() || stations.empty()) return;
  const double ground = upper_median(heights);
  const double limit = share * std::abs(upper_median(stations) - ground);
  for (int p = 0; p < network.points(); ++p) {
    Eigen::Vector3d& point = state.points[at(p)];
    if (std::abs(point.z() - ground) <= limit) continue;
    std::vector<double> east, north;
    for (int k = network.first_ray[at(p)]; k < network.first_ray[at(p) + 1]; ++k) {
      if (const auto foot = on_plane(network.rays[at(k)], state, ground)) {
        east.push_back(foot->x());
        north.push_back(foot->y());
      }
    }
    if (!east.empty()) point = {upper_median(east), upper_median(north), ground};
  }
}

}  // namespace

void drop_for_good(Network& network, int point) {
  network.undetermined[at(point)] = true;
  for (int k = network.first_ray[at(point)]; k < network.first_ray[at(point) + 1]; ++k)
    network.rays[at(k)].used = false;
}

double squared_sigmas(const Ray& ray, const State& state) {
  const auto residual = residual_of(ray, state);
  if (!residual) return std::numeric_limits<double>::infinity();
  return residual->squaredNorm() / (ray.sigma_px * ray.sigma_px);
}

int reject_rays(Network& network, const State& state, double sigmas) {
  int changed = 0;
  for (int p = 0; p < network.points(); ++p) {
    const int first = network.first_ray[at(p)], last = network.first_ray[at(p) + 1];
    std::vector<bool> good;
    for (int k = first; k < last; ++k) {
      good.push_back(squared_sigmas(network.rays[at(k)], state) <= sigmas * sigmas);
    }
    const bool enough =
        holds_together(network, p, std::count(good.begin(), good.end(), true), last - first);
    for (int k = first; k < last; ++k) {
      const bool use = enough && good[at(k - first)];
      changed += use != network.rays[at(k)].used ? 1 : 0;
      network.rays[at(k)].used = use;
    }
    couple(network, p, enough);
  }
  return changed;
}

void replant_wild_points(const Network& network, State& state) {
  replant_points_beyond(kWildHeight, network, state);
}

void replant_points(const Network& network, State& state) {
  replant_points_beyond(0, network, state);
}

int drop_points_at_cameras(Network& network, const State& state) {
  const double nearest = kAtCamera * std::abs(flying_height(network, state));
  int dropped = 0;
  for (int p = 0; p < network.points(); ++p) {
    const auto begin = network.rays.begin() + network.first_ray[at(p)];
    const auto end = network.rays.begin() + network.first_ray[at(p) + 1];
    const bool at_one = std::any_of(begin, end, [&](const Ray& ray) {
      return ray.used && (state.points[at(p)] - state.centre_of(ray)).norm() < nearest;
    });
    if (!at_one || network.layout.kept_of_point[at(p)] >= 0) continue;
    drop_for_good(network, p);
    ++dropped;
  }
  return dropped;
}

int drop_undetermined(Network& network, const NormalEquations& equations, double limit_m) {
  int dropped = 0;
  for (const PointLanes& points : equations.points) {
    for (int lane = 0; lane < points.count; ++lane) {
      const int p = points.point[at(lane)];
      if (used_rays(network, p) == 0) continue;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(normal_of(points, lane),
                                                                 Eigen::EigenvaluesOnly);
      if (modes.eigenvalues()[0] * limit_m * limit_m > 1) continue;
      drop_for_good(network, p);
      ++dropped;
    }
  }
  return dropped;
}

void drop_unprojectable(Network& network, const State& state) {
  for (Ray& ray : network.rays) {
    if (ray.used && !residual_of(ray, state)) ray.used = false;
  }
}

}  // namespace plumbline::orient
