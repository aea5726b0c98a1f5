// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/image.h"
#include "edge/base/result.h"
#include "edge/geodesy/local_frame.h"
#include "edge/geometry/camera.h"
#include "sim/climb_path.h"
#include "sim/flight.h"
#include "sim/profile.h"
#include "sim/world.h"

namespace plumbline::sim {

// A flight that is flown while time goes by: where the drone is and what its camera sees at any
// moment, not at the moments of a plan. Seconds count from its start, on the ground. Local ENU, the
// origin on the ground where it takes off; the antenna is at the camera. Immutable once made; the
// same profile and seed give the same flight.
class BenchFlight {
 public:
  // Climbs at the profile's rate to 2 m above its highest photo, goes aside by its first side-step,
  // and lands. The ground is made up, or painted with a photo. Fails where the profile's origin is
  // no place.
  static Result<BenchFlight> make(const Profile& profile, std::uint64_t seed, int threads,
                                  const std::optional<Image>& ground_photo = {});

  geometry::Pose pose_at(double seconds) const;
  geodesy::Geodetic antenna_at(double seconds) const;

  // Three channels, global shutter. Even grey from less than 2 m.
  Image photograph(double seconds) const;

  double duration_s() const { return path_.duration_s(); }
  const geodesy::LocalFrame& frame() const { return frame_; }
  const World& world() const { return world_; }
  const geometry::Camera& calibrated_camera() const { return flight_.calibrated_camera; }

  // The flight as truth.h takes it, of photos that were taken.
  struct Taken {
    std::string photo;
    double seconds = 0;  // middle of the exposure
  };
  Flight flown(const std::vector<Taken>& photos) const;

 private:
  BenchFlight(const Profile& profile, std::uint64_t seed, int threads, geodesy::LocalFrame frame,
              const std::optional<Image>& ground_photo);

  Flight flight_;  // without shots
  ClimbPath path_;
  geodesy::LocalFrame frame_;
  World world_;
  int threads_;
  double yaw_deg_;
};

}  // namespace plumbline::sim
