// SPDX-License-Identifier: MIT
#include "edge/plan/ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edge/base/index.h"

namespace plumbline::plan {
namespace {

constexpr double kRingsWanted = 5;
constexpr int kDirections = 8;
constexpr double kReliefWavelengthM = 50;

double middle_height_m(const Flight& flight) {
  std::vector<double> heights;
  for (const Eigen::Vector3d& place : flight.all_m()) heights.push_back(place.z());
  std::sort(heights.begin(), heights.end());
  return 0.5 * (heights[(heights.size() - 1) / 2] + heights[heights.size() / 2]);
}

double default_radius_m(const Flight& flight, const geometry::Camera& camera) {
  const double half_px = 0.5 * std::min(camera.width_px, camera.height_px);
  return half_px / camera.interior[geometry::kFocalLength] * middle_height_m(flight);
}

// The largest of 1, 2, 2.5, 5 times a power of ten that is not above `value`.
double neat(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  double best = power;
  for (const double step : {2.0, 2.5, 5.0}) {
    if (step * power <= value * (1 + 1e-9)) best = step * power;
  }
  return best;
}

GroundPoint on_ground(const Eigen::Vector2d& foot, const Eigen::Vector2d& from_foot, int ring,
                      const Options& options) {
  const Eigen::Vector2d place = foot + from_foot;
  return {{place.x(), place.y(), ground_height_m(from_foot, options)}, 1, ring};
}

// At a quarter and at three quarters of the ring's area, in eight directions each.
void add_ring(const Eigen::Vector2d& foot, const Ring& ring, int index, const Options& options,
              std::vector<GroundPoint>& out) {
  const double inner = ring.from_m * ring.from_m, outer = ring.to_m * ring.to_m;
  for (const double share : {0.25, 0.75}) {
    const double r = std::sqrt(inner + share * (outer - inner));
    for (int k = 0; k < kDirections; ++k) {
      const double a = 2 * std::numbers::pi * (k + share) / kDirections;
      out.push_back(on_ground(foot, r * Eigen::Vector2d(std::cos(a), std::sin(a)), index, options));
    }
  }
}

int photos_that_see(const geometry::Camera& camera, const std::vector<geometry::Pose>& poses,
                    const Eigen::Vector3d& point) {
  return static_cast<int>(std::count_if(
      poses.begin(), poses.end(), [&](const auto& pose) { return sees(camera, pose, point); }));
}

// Half the sides of a rectangle about the foot that holds all ground in the photos.
Eigen::Vector2d reach(const Eigen::Vector2d& foot, const std::vector<geometry::Pose>& poses,
                      const Options& options) {
  if (options.field_half_m) return *options.field_half_m;
  const geometry::Camera& camera = options.camera;
  Eigen::Vector2d half(0, 0);
  for (const geometry::Pose& pose : poses) {
    const Eigen::Vector2d picture_m = 0.5 * Eigen::Vector2d(camera.width_px, camera.height_px) *
                                      pose.centre_m.z() / camera.interior[geometry::kFocalLength];
    const Eigen::Vector2d aside = (pose.centre_m.head<2>() - foot).cwiseAbs();
    half = half.cwiseMax(1.1 * picture_m + aside);
  }
  return half;
}

// The R2 sequence: an even spread without a grid's regularity (M. Roberts 2018, "The unreasonable
// effectiveness of quasirandom sequences"; steps 1/g and 1/g^2 with g^3 = g + 1).
void add_spread(const Eigen::Vector2d& foot, const std::vector<geometry::Pose>& poses, int count,
                const Options& options, std::vector<GroundPoint>& out) {
  constexpr double kStepE = 0.7548776662466927, kStepN = 0.5698402909980532;
  const Eigen::Vector2d half = reach(foot, poses, options);
  const int tries = 20 * count;
  for (int i = 1, found = 0; i <= tries && found < count; ++i) {
    const double e = std::fmod(0.5 + i * kStepE, 1.0), n = std::fmod(0.5 + i * kStepN, 1.0);
    const GroundPoint point =
        on_ground(foot, half.cwiseProduct(Eigen::Vector2d(2 * e - 1, 2 * n - 1)), -1, options);
    if (photos_that_see(options.camera, poses, point.in_enu_m) < 2) continue;
    out.push_back(point);
    ++found;
  }
}

int spread_count(std::size_t photos, const Options& options, Detail detail) {
  constexpr int kFew = 200, kLeast = 60;
  constexpr int kFewRays = 24 * kFew, kManyRays = 80'000;
  const int rays = detail == Detail::kAll ? kManyRays : kFewRays;
  const int most = std::max(kLeast, rays / static_cast<int>(photos));
  const int wanted = detail == Detail::kAll ? std::max(options.ties, kFew) : kFew;
  return std::min(wanted, most);
}

void share_out_ties(std::size_t ring_points, int ties, std::vector<GroundPoint>& points) {
  constexpr double kOfRings = 0.01;
  const auto rings = static_cast<double>(ring_points);
  const auto spread = static_cast<double>(points.size() - ring_points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].ties = i < ring_points ? kOfRings * ties / rings : (1 - kOfRings) * ties / spread;
  }
}

}  // namespace

std::vector<Ring> rings_of(const Flight& flight, const Options& options) {
  const double radius = options.radius_m.value_or(default_radius_m(flight, options.camera));
  const double width = neat(radius / kRingsWanted);
  std::vector<Ring> rings;
  for (int k = 0; (k + 1) * width <= radius * (1 + 1e-9); ++k) {
    rings.push_back({k * width, (k + 1) * width});
  }
  if (options.radius_m && radius - rings.back().to_m > 1e-6 * radius) {
    rings.push_back({rings.back().to_m, radius});
  }
  return rings;
}

std::vector<GroundPoint> ground_points(const Flight& flight,
                                       const std::vector<geometry::Pose>& poses,
                                       const std::vector<Ring>& rings, const Options& options,
                                       Detail detail) {
  const Eigen::Vector2d foot = foot_of(flight);
  std::vector<GroundPoint> points{on_ground(foot, {0, 0}, -1, options)};
  for (std::size_t k = 0; k < rings.size(); ++k) {
    add_ring(foot, rings[k], static_cast<int>(k), options, points);
  }
  const std::size_t ring_points = points.size();
  add_spread(foot, poses, spread_count(poses.size(), options, detail), options, points);
  share_out_ties(ring_points, options.ties, points);
  return points;
}

double ground_height_m(const Eigen::Vector2d& from_foot_m, const Options& options) {
  const double turn = 2 * std::numbers::pi / kReliefWavelengthM;
  return options.relief_m *
         (std::sin(turn * from_foot_m.x()) + std::cos(0.8 * turn * from_foot_m.y()));
}

bool sees(const geometry::Camera& camera, const geometry::Pose& pose,
          const Eigen::Vector3d& point) {
  const auto pixel = geometry::project(
      camera.interior, pose.ground_from_photo.transpose() * (point - pose.centre_m));
  return pixel && pixel->x() >= 0 && pixel->y() >= 0 && pixel->x() <= camera.width_px - 1 &&
         pixel->y() <= camera.height_px - 1;
}

}  // namespace plumbline::plan
