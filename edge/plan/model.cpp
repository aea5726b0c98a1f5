// SPDX-License-Identifier: MIT
#include "edge/plan/model.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <optional>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::plan {
namespace {

// Turned on by it from photo to photo, no pattern of few photos repeats.
constexpr double kGoldenAngleRad = 2.399963229728653;
// Control points stand far out: there they see a turn of the whole.
constexpr double kControlShare = 0.8;

// (cos, sin) of the photo's angle, each with a root mean square of `rms`.
Eigen::Vector2d pattern(std::size_t photo, double phase_rad, double rms) {
  const double angle = static_cast<double>(photo) * kGoldenAngleRad + phase_rad;
  return rms * std::numbers::sqrt2 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

geometry::Pose pose_at(const Eigen::Vector3d& place, std::size_t photo, const Options& options) {
  const Eigen::Vector2d tilt = pattern(photo, 0, options.tilt_deg * kRadPerDeg);
  const double turn = pattern(photo, 2, options.tilt_deg * kRadPerDeg).x();
  return {place, geometry::ground_from_photo({tilt.x(), tilt.y(), turn})};
}

orient::Photo photo_of(const geometry::Pose& pose, const std::optional<PhotoFix>& fix,
                       const Options& options) {
  orient::Photo photo;
  if (fix) photo.station = orient::Station{pose.centre_m, fix->covariance_m2};
  if (fix && options.delay_sigma_s > 0) photo.velocity_in_enu_m_s = fix->velocity_m_s;
  if (options.heading_sigma_deg) {
    photo.heading = orient::HeadingPrior{-geometry::angles_of(pose.ground_from_photo).kappa_rad,
                                         *options.heading_sigma_deg * kRadPerDeg};
  }
  return photo;
}

// What is known of the place of a photo, by its number in the flight.
std::optional<PhotoFix> fix_of(std::size_t photo, const Flight& flight, const Options& options) {
  if (photo < flight.taken_fixes.size()) return flight.taken_fixes[photo];
  if (!options.rtk) return std::nullopt;
  const double h = options.rtk->sigma_horizontal_m, v = options.rtk->sigma_vertical_m;
  return PhotoFix{Eigen::Matrix3d(Eigen::Vector3d(h * h, h * h, v * v).asDiagonal()),
                  {0, 0, options.costs.climb_rate_m_s}};
}

int add_mark(const Eigen::Vector2d& foot, const Eigen::Vector2d& from_foot, const Options& options,
             Model& model) {
  const Eigen::Vector2d place = foot + from_foot;
  model.points.push_back({{place.x(), place.y(), ground_height_m(from_foot, options)}, 1, -1});
  return static_cast<int>(model.points.size()) - 1;
}

void add_known(const Eigen::Vector2d& foot, const Options& options, Model& model) {
  if (options.known_length_m) {
    const Eigen::Vector2d half(0.5 * *options.known_length_m, 0);
    const int a = add_mark(foot, -half, options, model), b = add_mark(foot, half, options, model);
    const double metres = (model.points[at(b)].in_enu_m - model.points[at(a)].in_enu_m).norm();
    model.problem.lengths.push_back({a, b, metres, options.length_sigma_m});
  }
  const double radius = kControlShare * model.rings.back().to_m;
  for (int k = 0; k < options.control_points; ++k) {
    const double angle = 1 + k * kGoldenAngleRad;
    const int mark =
        add_mark(foot, radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), options, model);
    const double variance = options.control_sigma_m * options.control_sigma_m;
    model.problem.control.push_back(
        {mark, model.points[at(mark)].in_enu_m, variance * Eigen::Matrix3d::Identity()});
  }
}

void observe(const Options& options, Model& model) {
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    for (std::size_t i = 0; i < model.truth.poses.size(); ++i) {
      const geometry::Pose& pose = model.truth.poses[i];
      const Eigen::Vector3d& point = model.points[p].in_enu_m;
      if (!sees(options.camera, pose, point)) continue;
      const auto pixel = geometry::project(
          options.camera.interior, pose.ground_from_photo.transpose() * (point - pose.centre_m));
      model.problem.observations.push_back({static_cast<int>(i), static_cast<int>(p), *pixel,
                                            options.sigma_px, orient::ImageGroup::kStated});
    }
  }
}

Status bad(const std::string& sentence) { return Error{sentence}; }

bool positive(double value) { return value > 0 && std::isfinite(value); }

Status check_sigmas(const Options& options) {
  if (!positive(options.sigma_px)) return bad("The image sigma must be a number above 0.");
  if (options.rtk &&
      !(positive(options.rtk->sigma_horizontal_m) && positive(options.rtk->sigma_vertical_m))) {
    return bad("The sigmas of RTK positions must be numbers above 0.");
  }
  if (!(options.delay_sigma_s >= 0 && std::isfinite(options.delay_sigma_s))) {
    return bad("The sigma of the delay must be a number of seconds from 0 on.");
  }
  if (options.heading_sigma_deg && !positive(*options.heading_sigma_deg)) {
    return bad("The sigma of the heading must be a number above 0.");
  }
  if (options.known_length_m && !positive(*options.known_length_m)) {
    return bad("The known length must be a number above 0.");
  }
  if (!(options.wander_m >= 0 && options.tilt_deg >= 0 && std::isfinite(options.wander_m) &&
        options.tilt_deg <= 45)) {
    return bad("Wander and tilt must be numbers from 0 on, the tilt up to 45 degrees.");
  }
  if (options.goal_m && !positive(*options.goal_m)) {
    return bad("The goal must be a sigma above 0, in metres.");
  }
  if (options.radius_m && !positive(*options.radius_m)) {
    return bad("The radius must be a number above 0, in metres.");
  }
  return Done{};
}

Status check_fixes(const Flight& flight) {
  if (flight.taken_fixes.empty()) return Done{};
  if (flight.taken_fixes.size() != flight.taken_m.size()) {
    return bad("Each photo that was taken needs a fix of its own, or none of them has one.");
  }
  for (const PhotoFix& fix : flight.taken_fixes) {
    const Eigen::LLT<Eigen::Matrix3d> factor(fix.covariance_m2);
    if (!fix.covariance_m2.allFinite() || !fix.velocity_m_s.allFinite() ||
        factor.info() != Eigen::Success) {
      return bad("The covariance of each position must be a positive one, in numbers.");
    }
  }
  return Done{};
}

// Both ends must be in two photos, or the length would silently do nothing.
Status check_length(const Flight& flight, const Options& options) {
  if (!options.known_length_m) return Done{};
  const auto poses = poses_of(flight, options);
  const Eigen::Vector2d foot = foot_of(flight), half(0.5 * *options.known_length_m, 0);
  for (const Eigen::Vector2d& end : {Eigen::Vector2d(foot - half), Eigen::Vector2d(foot + half)}) {
    int seen = 0;
    for (const auto& pose : poses)
      seen += sees(options.camera, pose, {end.x(), end.y(), 0}) ? 1 : 0;
    if (seen < 2) {
      return bad(
          "The known length is too long: its ends are not in two photos. Give one that "
          "lies within the pictures.");
    }
  }
  return Done{};
}

}  // namespace

std::vector<geometry::Pose> poses_of(const Flight& flight, const Options& options) {
  std::vector<geometry::Pose> poses;
  for (const Eigen::Vector3d& place : flight.taken_m) {
    poses.push_back(pose_at(place, poses.size(), options));
  }
  for (const Eigen::Vector3d& place : flight.ahead_m) {
    const Eigen::Vector2d off = pattern(poses.size(), 1, options.wander_m);
    poses.push_back(pose_at(place + Eigen::Vector3d(off.x(), off.y(), 0), poses.size(), options));
  }
  return poses;
}

Model model_of(const Flight& flight, const Options& options, Detail detail) {
  Model model;
  model.rings = rings_of(flight, options);
  model.truth.interior = options.camera.interior;
  model.truth.line_time_s = options.camera.line_time_us * kSecondsPerMicrosecond;
  model.truth.poses = poses_of(flight, options);
  model.points = ground_points(flight, model.truth.poses, model.rings, options, detail);
  model.problem.camera = options.camera;
  model.problem.delay.sigma_s = options.delay_sigma_s;
  for (const auto& pose : model.truth.poses) {
    const auto fix = fix_of(model.problem.photos.size(), flight, options);
    model.problem.photos.push_back(photo_of(pose, fix, options));
    model.georeferenced = model.georeferenced || fix.has_value();
    model.problem.photos.back().name = std::to_string(model.problem.photos.size());
  }
  add_known(foot_of(flight), options, model);
  for (const GroundPoint& point : model.points) model.truth.points.push_back(point.in_enu_m);
  model.problem.point_names.resize(model.points.size());
  observe(options, model);
  return model;
}

Status check(const Flight& flight, const Options& options) {
  constexpr std::size_t kMostPhotos = 200;
  if (flight.photos() < 2) {
    return bad(
        "The flight has one photo only; two from different places are needed at least: let "
        "the climb end higher, or the step be smaller.");
  }
  if (flight.photos() > kMostPhotos) {
    return bad("The flight has " + std::to_string(flight.photos()) + " photos, more than " +
               std::to_string(kMostPhotos) + ": let the step be larger.");
  }
  for (const Eigen::Vector3d& place : flight.all_m()) {
    if (!place.allFinite() || !(place.z() > 0)) {
      return bad("Each photo needs a place in numbers, above the ground.");
    }
  }
  if (options.ties < 10) return bad("There must be 10 ties at least.");
  if (auto status = check_fixes(flight); !status) return status;
  if (auto status = check_sigmas(options); !status) return status;
  return check_length(flight, options);
}

}  // namespace plumbline::plan
