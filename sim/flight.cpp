// SPDX-License-Identifier: MIT
#include "sim/flight.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "sim/random.h"

namespace plumbline::sim {
namespace {

enum Stream : std::uint64_t { kCamera = 11, kPath, kAttitude, kGnss, kCompass, kSensor };

Eigen::Vector2d towards(double azimuth_deg) {
  return {std::sin(azimuth_deg * kRadPerDeg), std::cos(azimuth_deg * kRadPerDeg)};
}

geometry::Camera true_camera(const Profile& profile) {
  geometry::Camera camera;
  camera.name = "Simulated camera";
  camera.width_px = profile.width_px;
  camera.height_px = profile.height_px;
  camera.interior << profile.focal_length_px,
      0.5 * (profile.width_px - 1) + profile.principal_offset_px[0],
      0.5 * (profile.height_px - 1) + profile.principal_offset_px[1], 0, 0, profile.radial[0],
      profile.radial[1], profile.radial[2], profile.tangential[0], profile.tangential[1];
  camera.sigma.setZero();
  return camera;
}

geometry::Camera calibrated(const geometry::Camera& truth, const Profile& profile, Random random) {
  geometry::Camera camera = truth;
  camera.sigma << profile.focal_sigma_px, profile.principal_sigma_px, profile.principal_sigma_px, 0,
      0, profile.radial_sigma, profile.radial_sigma, 0, profile.tangential_sigma,
      profile.tangential_sigma;
  for (int k = 0; k < geometry::kInteriorCount; ++k) {
    camera.interior[k] += camera.sigma[k] * random.normal();
  }
  return camera;
}

// Where each photo is wanted: straight up, then aside.
std::vector<Eigen::Vector3d> wanted_stations_m(const Profile& profile, Random& random) {
  std::vector<Eigen::Vector3d> stations_m;
  for (const double height_m : climb_heights_m(profile)) stations_m.emplace_back(0, 0, height_m);
  const double random_direction_deg = random.uniform(0, 360);
  double direction_deg = profile.side_direction_deg.value_or(random_direction_deg);
  for (const double step_m : profile.side_steps_m) {
    Eigen::Vector3d next_m = stations_m.back();
    next_m.head<2>() += step_m * towards(direction_deg);
    stations_m.push_back(next_m);
    direction_deg += 90;
  }
  return stations_m;
}

// Where it was: slanting off with the height, unsteady.
std::vector<Eigen::Vector3d> flown_stations_m(const Profile& profile, Random random) {
  std::vector<Eigen::Vector3d> stations_m = wanted_stations_m(profile, random);
  const Eigen::Vector2d drift_m = profile.drift_m * towards(random.uniform(0, 360));
  const double range_m = std::max(profile.to_m - profile.from_m, 1e-3);
  for (Eigen::Vector3d& station_m : stations_m) {
    station_m.head<2>() += drift_m * (station_m.z() - profile.from_m) / range_m;
    station_m +=
        Eigen::Vector3d(profile.wander_m * random.normal(), profile.wander_m * random.normal(),
                        profile.height_sigma_m * random.normal());
  }
  return stations_m;
}

std::vector<double> times_s(const Profile& profile,
                            const std::vector<Eigen::Vector3d>& stations_m) {
  std::vector<double> times{0};
  for (std::size_t k = 1; k < stations_m.size(); ++k) {
    const double way_m = (stations_m[k] - stations_m[k - 1]).norm();
    const double exact_s = times.back() + way_m / profile.climb_rate_m_s + profile.pause_s;
    times.push_back(std::round(1000 * exact_s) / 1000);  // EXIF holds milliseconds
  }
  return times;
}

std::vector<geometry::OmegaPhiKappa> attitudes(const Profile& profile, std::size_t count,
                                               Random random) {
  const double random_yaw_deg = random.uniform(0, 360);
  const double yaw_deg = profile.yaw_deg.value_or(random_yaw_deg);
  const double tilt_rad = profile.tilt_sigma_deg * kRadPerDeg;
  std::vector<geometry::OmegaPhiKappa> angles;
  for (std::size_t k = 0; k < count; ++k) {
    const double omega_rad = tilt_rad * random.normal();
    const double phi_rad = tilt_rad * random.normal();
    const double turn_deg = profile.yaw_sigma_deg * random.normal();
    angles.push_back({omega_rad, phi_rad, -(yaw_deg + (k > 0 ? turn_deg : 0.0)) * kRadPerDeg});
  }
  return angles;
}

// Azimuth of the top of the photo (its +y axis), degrees from north, clockwise.
double azimuth_deg(const geometry::Pose& pose) {
  const Eigen::Vector3d top = pose.ground_from_photo.col(1);
  return std::atan2(top.x(), top.y()) * kDegPerRad;
}

std::string photo_name(std::size_t index) {
  char text[32];
  std::snprintf(text, sizeof text, "%04zu.jpg", index + 1);
  return text;
}

}  // namespace

Flight fly(const Profile& profile, std::uint64_t seed) {
  Flight flight{profile, seed, true_camera(profile), {}, {}};
  flight.calibrated_camera = calibrated(flight.camera, profile, Random(seed, kCamera));
  const auto stations_m = flown_stations_m(profile, Random(seed, kPath));
  const auto times = times_s(profile, stations_m);
  const auto angles = attitudes(profile, stations_m.size(), Random(seed, kAttitude));
  Random gnss_random(seed, kGnss);
  const auto errors_m = gnss_errors(profile.gnss_error, times, gnss_random);
  const double compass_error_deg = profile.heading_sigma_deg * Random(seed, kCompass).normal();
  for (std::size_t k = 0; k < stations_m.size(); ++k) {
    Shot shot;
    shot.photo = photo_name(k);
    shot.time_s = times[k];
    shot.pose = {stations_m[k], geometry::ground_from_photo(angles[k])};
    shot.gnss_in_enu_m = stations_m[k] + errors_m[k];
    shot.compass_deg = std::fmod(azimuth_deg(shot.pose) + compass_error_deg + 720, 360);
    flight.shots.push_back(shot);
  }
  return flight;
}

WorldOptions world_for(const Profile& profile, std::uint64_t seed, int threads) {
  const double half_diagonal_px =
      std::hypot(profile.width_px, profile.height_px) / 2 +
      std::hypot(profile.principal_offset_px[0], profile.principal_offset_px[1]);
  const double widest_rad = std::atan(1.1 * half_diagonal_px / profile.focal_length_px) +
                            4 * profile.tilt_sigma_deg * kRadPerDeg;
  double aside_m = profile.drift_m + 4 * profile.wander_m;
  for (const double step_m : profile.side_steps_m) aside_m += step_m;
  const double reach_m = (profile.to_m + 4) * std::tan(std::min(widest_rad, 1.3)) + aside_m;
  WorldOptions options;
  options.half_extent_m = std::clamp(reach_m, 40.0, 1500.0);
  options.relief = profile.relief;
  options.photo_texel_m = profile.texture_pixel_m;
  options.seed = seed;
  options.threads = threads;
  // A disc is 12 px wide from the lowest height, and 6 px at the least from the highest.
  const double fitting_m =
      std::max(12 * profile.from_m, 6 * profile.to_m) / profile.focal_length_px;
  const double half_height_m = 0.5 * profile.height_px / profile.focal_length_px * profile.to_m;
  options.targets.count = profile.targets;
  options.targets.disc_radius_m = profile.target_diameter_m.value_or(fitting_m) / 2;
  options.targets.field_m *= std::min(1.0, 0.8 * half_height_m / options.targets.field_m.y());
  options.targets.lowest_to_highest = profile.from_m / profile.to_m;
  options.targets.seed = seed;
  return options;
}

SensorOptions sensor_for(const Flight& flight, std::size_t photo) {
  const Profile& profile = flight.profile;
  SensorOptions sensor;
  sensor.blur_sigma_px = profile.blur_px;
  sensor.motion_blur_px = profile.motion_blur_px;
  sensor.motion_direction_rad = Random(flight.seed, mixed(kSensor, photo)).uniform(0, 6.2831853);
  sensor.read_variance *= profile.noise * profile.noise;
  sensor.shot_variance *= profile.noise * profile.noise;
  sensor.vignetting = profile.vignetting;
  return sensor;
}

Image photograph(const World& world, const Flight& flight, std::size_t photo, int threads) {
  return render(world, flight.camera, flight.shots[photo].pose, sensor_for(flight, photo),
                mixed(mixed(flight.seed, kSensor), photo), threads);
}

std::optional<Eigen::Vector2d> seen_at(const World& world, const Flight& flight, std::size_t photo,
                                       const Target& target) {
  const geometry::Pose& pose = flight.shots[photo].pose;
  const auto pixel_of = [&](const Eigen::Vector3d& point_m) {
    return geometry::project(flight.camera.interior,
                             pose.ground_from_photo.transpose() * (point_m - pose.centre_m));
  };
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector2d across_m = target.plate_radius_m() * towards(45.0 * k);
    const Eigen::Vector3d rim_m =
        target.centre_m + Eigen::Vector3d(across_m.x(), across_m.y(), target.slope.dot(across_m));
    const auto pixel = pixel_of(rim_m);
    if (!pixel || pixel->x() < 1 || pixel->y() < 1 || pixel->x() > flight.camera.width_px - 2 ||
        pixel->y() > flight.camera.height_px - 2) {
      return std::nullopt;
    }
    const Eigen::Vector3d ray = rim_m - pose.centre_m;
    const Eigen::Vector2d per_metre = ray.head<2>() / ray.z();
    const Eigen::Vector2d at_zero_m = rim_m.head<2>() - rim_m.z() * per_metre;
    const double met_m = world.terrain().meet(
        {at_zero_m.x(), at_zero_m.y(), per_metre.x(), per_metre.y()}, rim_m.z());
    if (std::abs(met_m - rim_m.z()) > 0.01) return std::nullopt;
  }
  return pixel_of(target.centre_m);
}

}  // namespace plumbline::sim
