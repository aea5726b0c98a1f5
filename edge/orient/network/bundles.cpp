// SPDX-License-Identifier: MIT
#include "edge/orient/network/bundles.h"

#include <algorithm>

namespace plumbline::orient {
namespace {

using geometry::InteriorVector;

// Image-plane coordinates beyond this are no image: what is computed with them must stay finite.
constexpr double kMostSquaredRadius = 1e12;

void pack_ray(const Network& network, const Ray& ray, int lane, BundleRays& out) {
  const double effect = ray.group == ImageGroup::kTies ? network.ties_design_effect : 1;
  out.slot = ray.slot;
  out.u[lane] = ray.pixel.x();
  out.v[lane] = ray.pixel.y();
  out.information[lane] = ray.used ? 1 / (ray.sigma_px * ray.sigma_px * effect) : 0;
  out.rows[lane] = ray.pixel.y() - (network.problem->camera.height_px - 1) / 2.0;
}

void pack_bundle(const Network& network, const Bundle& bundle, Bundles& out) {
  const int rays = static_cast<int>(network.groups[at(bundle.group)].slots.size());
  for (int k = 0; k < rays; ++k) {
    BundleRays& packed = out.rays.emplace_back();
    for (int lane = 0; lane < kLanes; ++lane) {
      const int first = network.first_ray[at(bundle.point[at(lane)])];
      pack_ray(network, network.rays[at(first + k)], lane, packed);
      if (lane >= bundle.count) packed.information[lane] = 0;
    }
  }
}

Eigen::Vector3d velocity_of(const Network& network, int slot) {
  return network.photo(slot).velocity_in_enu_m_s.value_or(Eigen::Vector3d::Zero());
}

// Positive where a point (depth in front of the camera) can be projected; see camera.cpp.
Lanes clearance(const InteriorVector& interior, const Lanes& depth, const Lanes& r2) {
  Lanes least = depth.min(kMostSquaredRadius - r2);
  for (const double fraction : {0.25, 0.5, 0.75, 1.0}) {
    least = least.min(geometry::radial_growth<Lanes>(interior, fraction * r2));
  }
  return least;
}

// Where a ray is hidden, something that can be computed with stands in for it.
void stand_in(const InteriorVector& interior, SeenRays& rays, const Lanes& clear) {
  rays.hidden = !(clear > 0);
  rays.inverse_depth = rays.hidden.select(Lanes::Ones(), rays.inverse_depth);
  const Lanes x = rays.hidden.select(Lanes::Zero(), rays.distorted.x);
  const Lanes y = rays.hidden.select(Lanes::Zero(), rays.distorted.y);
  rays.distorted = geometry::distorted<Lanes>(interior, x, y);
  rays.information = rays.hidden.select(Lanes::Zero(), rays.information);
}

}  // namespace

Bundles bundles_of(const Network& network) {
  Bundles out;
  for (std::size_t g = 0; g < network.groups.size(); ++g) {
    const std::vector<int>& points = network.groups[g].points;
    for (std::size_t first = 0; first < points.size(); first += kLanes) {
      Bundle bundle;
      bundle.group = static_cast<int>(g);
      bundle.count = static_cast<int>(std::min<std::size_t>(kLanes, points.size() - first));
      bundle.point.fill(points[first]);
      for (int lane = 0; lane < bundle.count; ++lane) {
        bundle.point[at(lane)] = points[first + at(lane)];
      }
      bundle.first_ray = static_cast<int>(out.rays.size());
      pack_bundle(network, bundle, out);
      out.bundles.push_back(bundle);
    }
  }
  return out;
}

Lanes3 points_of(const Bundle& bundle, const State& state) {
  Lanes3 points;
  for (int lane = 0; lane < kLanes; ++lane) {
    const Eigen::Vector3d& point = state.points[at(bundle.point[at(lane)])];
    for (int i = 0; i < 3; ++i) points[at(i)][lane] = point[i];
  }
  return points;
}

// Photo-frame point q = R' (P - C).
SeenRays seen(const Network& network, const BundleRays& rays, const Lanes3& points,
              const State& state) {
  const geometry::Pose& pose = state.poses[at(rays.slot)];
  const Eigen::Matrix3d& r = pose.ground_from_photo;
  SeenRays out;
  Lanes3& d = out.from_centre;
  for (int i = 0; i < 3; ++i) d[at(i)] = points[at(i)] - pose.centre_m[i];
  if (state.line_time_s != 0) {
    const Eigen::Vector3d per_row = state.line_time_s * velocity_of(network, rays.slot);
    for (int i = 0; i < 3; ++i) d[at(i)] -= per_row[i] * rays.rows;
  }
  const Lanes depth = -(r(0, 2) * d[0] + r(1, 2) * d[1] + r(2, 2) * d[2]);
  out.inverse_depth = 1 / depth;
  const Lanes x = (r(0, 0) * d[0] + r(1, 0) * d[1] + r(2, 0) * d[2]) * out.inverse_depth;
  const Lanes y = -(r(0, 1) * d[0] + r(1, 1) * d[1] + r(2, 1) * d[2]) * out.inverse_depth;
  out.distorted = geometry::distorted<Lanes>(state.interior, x, y);
  out.information = rays.information;
  out.hidden.setConstant(false);
  const Lanes clear = clearance(state.interior, depth, out.distorted.r2);
  if (!(clear > 0).all()) stand_in(state.interior, out, clear);
  out.u = geometry::pixel_u(state.interior, out.distorted) - rays.u;
  out.v = geometry::pixel_v(state.interior, out.distorted) - rays.v;
  return out;
}

// For the increment R <- exp([d]x) R:  dq = R' (dP - dC) + R' [P - C]x dd, and a row a' [P - C]x is
// (a x (P - C))'. The C of a row moves with line time, not that of the pose.
void differentiate(const Network& network, const SeenRays& rays, const BundleRays& measured,
                   const State& state, const Lanes& scale, LinearRays& out) {
  std::array<PixelLanes, 3> q;
  geometry::pixel_by_interior(state.interior, rays.distorted, scale, out.by_common.data());
  geometry::pixel_by_point(state.interior, rays.distorted, rays.inverse_depth, scale, q.data());
  const Eigen::Matrix3d& r = state.poses[at(measured.slot)].ground_from_photo;
  for (int i = 0; i < 3; ++i) {
    PixelLanes& a = out.by_point[at(i)];
    a = {q[0].u * r(i, 0) + q[1].u * r(i, 1) + q[2].u * r(i, 2),
         q[0].v * r(i, 0) + q[1].v * r(i, 1) + q[2].v * r(i, 2)};
    out.by_common[at(kShared + i)] = {-a.u, -a.v};
  }
  const auto& a = out.by_point;
  const Lanes3& d = rays.from_centre;
  for (int i = 0; i < 3; ++i) {
    const std::size_t j = at((i + 1) % 3), k = at((i + 2) % 3);
    out.by_common[at(kShared + 3 + i)] = {a[j].u * d[k] - a[k].u * d[j],
                                          a[j].v * d[k] - a[k].v * d[j]};
  }
  if (network.shared_mask[kLineTime] == 0) return;
  const Eigen::Vector3d v = velocity_of(network, measured.slot);
  out.by_common[kLineTime] = {-(a[0].u * v[0] + a[1].u * v[1] + a[2].u * v[2]) * measured.rows,
                              -(a[0].v * v[0] + a[1].v * v[1] + a[2].v * v[2]) * measured.rows};
}

}  // namespace plumbline::orient
