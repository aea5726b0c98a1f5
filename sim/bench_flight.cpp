// SPDX-License-Identifier: MIT
#include "sim/bench_flight.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "sim/random.h"
#include "sim/renderer.h"

namespace plumbline::sim {
namespace {

constexpr std::uint64_t kYawStream = 41;
constexpr double kWait_s = 15;     // on the ground: for a position, the clock, and test pulses
constexpr double kAbove_m = 2;     // the highest photo
constexpr double kNearest_m = 2;   // to the ground that a picture is painted
constexpr double kUnsteady_m = 3;  // how far gusts may carry it
constexpr double kTurn_deg = 2;    // of the yaw, to and fro

ClimbPathOptions path_options(const Profile& profile) {
  ClimbPathOptions options;
  options.wait_s = kWait_s;
  options.climb_m_s = profile.climb_rate_m_s;
  options.top_m = profile.to_m + kAbove_m;
  options.aside_m = profile.side_steps_m.empty() ? 0 : profile.side_steps_m.front();
  return options;
}

Profile with_gusts(Profile profile) {
  profile.drift_m += kUnsteady_m;
  return profile;
}

// Between -1 and 1 with a mean square of a half, to and fro.
double sway(double seconds, double period_s, double phase) {
  return std::sin(2 * std::numbers::pi * (seconds / period_s + phase));
}

}  // namespace

Result<BenchFlight> BenchFlight::make(const Profile& profile, std::uint64_t seed, int threads,
                                      const std::optional<Image>& ground_photo) {
  auto frame = geodesy::LocalFrame::at(
      {profile.origin_latitude_deg, profile.origin_longitude_deg, profile.origin_height_m});
  if (!frame) return frame.error();
  return BenchFlight(profile, seed, threads, std::move(*frame), ground_photo);
}

BenchFlight::BenchFlight(const Profile& profile, std::uint64_t seed, int threads,
                         geodesy::LocalFrame frame, const std::optional<Image>& ground_photo)
    : flight_(fly(profile, seed)),
      path_(path_options(profile), seed),
      frame_(std::move(frame)),
      world_(world_for(with_gusts(profile), seed, threads), ground_photo),
      threads_(threads),
      yaw_deg_(profile.yaw_deg.value_or(Random(seed, kYawStream).uniform(0, 360))) {
  flight_.shots.clear();
}

geometry::Pose BenchFlight::pose_at(double seconds) const {
  const double tilt_rad =
      flight_.profile.tilt_sigma_deg * kRadPerDeg * std::numbers::sqrt2;  // of a sine
  const double yaw_deg = yaw_deg_ + kTurn_deg * sway(seconds, 37, 0.2);
  const geometry::OmegaPhiKappa angles{tilt_rad * sway(seconds, 5.3, 0.1),
                                       tilt_rad * sway(seconds, 4.1, 0.6), -yaw_deg * kRadPerDeg};
  return {path_.at(seconds), geometry::ground_from_photo(angles)};
}

geodesy::Geodetic BenchFlight::antenna_at(double seconds) const {
  return frame_.geodetic_of(path_.at(seconds));
}

Image BenchFlight::photograph(double seconds) const {
  const geometry::Pose pose = pose_at(seconds);
  const geometry::Camera& camera = flight_.camera;
  if (pose.centre_m.z() < kNearest_m) {
    Image grey;
    grey.width_px = camera.width_px, grey.height_px = camera.height_px, grey.channels = 3;
    grey.data.assign(3 * static_cast<std::size_t>(camera.width_px * camera.height_px), 128);
    return grey;
  }
  const auto moment = static_cast<std::uint64_t>(std::llround(seconds * 1e6));
  return render(world_, camera, pose, sensor_for(flight_, moment), mixed(flight_.seed, moment),
                threads_);
}

Flight BenchFlight::flown(const std::vector<Taken>& photos) const {
  Flight flight = flight_;
  for (const Taken& taken : photos) {
    Shot shot;
    shot.photo = taken.photo;
    shot.time_s = taken.seconds;
    shot.pose = pose_at(taken.seconds);
    shot.gnss_in_enu_m = shot.pose.centre_m;
    flight.shots.push_back(shot);
  }
  return flight;
}

}  // namespace plumbline::sim
