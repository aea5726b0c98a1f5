// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edge/geometry/camera.h"
#include "sim/profile.h"
#include "sim/renderer.h"
#include "sim/world.h"

namespace plumbline::sim {

// One photo as it was taken, and what the instruments said. Local ENU, metres; the antenna is at
// the camera.
struct Shot {
  std::string photo;  // 0001.jpg, ...
  double time_s = 0;  // since the first photo
  geometry::Pose pose;
  Eigen::Vector3d gnss_in_enu_m = Eigen::Vector3d::Zero();
  double compass_deg = 0;  // azimuth of the top of the photo, 0..360
};

struct Flight {
  Profile profile;
  std::uint64_t seed = 1;
  geometry::Camera camera;             // as it is; every sigma 0
  geometry::Camera calibrated_camera;  // as its calibration says, with the sigmas of that
  std::vector<Shot> shots;
};

// The same profile and seed give the same flight.
Flight fly(const Profile& profile, std::uint64_t seed);

// A world wide and detailed enough for all photos of `profile`.
WorldOptions world_for(const Profile& profile, std::uint64_t seed, int threads);

// Sensor of one photo: `photo` counts from 0.
SensorOptions sensor_for(const Flight& flight, std::size_t photo);

// The photo, 3 channels.
Image photograph(const World& world, const Flight& flight, std::size_t photo, int threads);

// The pixel of a target's centre in a photo that sees its whole plate, nothing in between.
std::optional<Eigen::Vector2d> seen_at(const World& world, const Flight& flight, std::size_t photo,
                                       const Target& target);

}  // namespace plumbline::sim
