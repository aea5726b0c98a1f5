// SPDX-License-Identifier: MIT
#include "firmware/commands/sim_output.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "edge/geodesy/local_frame.h"
#include "edge/jpeg/jpeg.h"
#include "firmware/deliver/photo_writer.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;
using deliver::write_whole_file;

constexpr std::chrono::minutes kJapanTime{9 * 60};

// A morning in spring: the same for every flight, so that the same seed gives the same bytes.
UtcTime start_time() {
  using namespace std::chrono;
  return sys_days{year{2026} / April / 18} + hours{1} + minutes{12} + seconds{3} +
         milliseconds{250};
}

int rtk_flag(sim::Fix fix) {
  if (fix == sim::Fix::kFixed) return 50;
  return fix == sim::Fix::kFloat ? 34 : 16;
}

// What a receiver would state: all parts that it can know of, none where it has no corrections.
std::optional<Eigen::Vector3d> stated_sigma_m(const sim::Profile& profile) {
  if (profile.fix == sim::Fix::kSingle) return std::nullopt;
  Eigen::Vector3d variance = profile.gnss_error.white.per_axis().cwiseAbs2() +
                             profile.gnss_error.correlated.per_axis().cwiseAbs2();
  if (profile.fix == sim::Fix::kFloat) {
    variance += profile.gnss_error.offset.per_axis().cwiseAbs2();
  }
  return variance.cwiseSqrt();
}

deliver::PhotoPosition position(const sim::Profile& profile, const sim::Shot& shot,
                                const geodesy::LocalFrame& frame) {
  const geodesy::Geodetic place = frame.geodetic_of(shot.gnss_in_enu_m);
  return {place.latitude_deg, place.longitude_deg, place.height_ellipsoidal_m,
          rtk_flag(profile.fix), stated_sigma_m(profile)};
}

deliver::PhotoTags tags_of(const sim::Flight& flight, const sim::Shot& shot,
                           const geodesy::LocalFrame& frame) {
  const sim::Profile& profile = flight.profile;
  deliver::PhotoTags tags;
  tags.make = "Plumbline";
  tags.model = flight.camera.name;
  tags.time = start_time() + std::chrono::milliseconds(std::llround(1000 * shot.time_s));
  tags.utc_offset = kJapanTime;
  tags.width_px = profile.width_px;
  tags.height_px = profile.height_px;
  tags.pixel_pitch_um = profile.pixel_pitch_um;
  tags.focal_length_mm = profile.focal_length_px * profile.pixel_pitch_um * 1e-3;
  tags.gimbal_pitch_deg = -90.0;
  tags.gimbal_roll_deg = 0.0;
  if (profile.heading) tags.gimbal_yaw_deg = std::remainder(shot.compass_deg, 360.0);
  if (!profile.gnss) return tags;
  tags.position = position(profile, shot, frame);
  tags.height_above_start_m = shot.gnss_in_enu_m.z();
  tags.velocity_north_east_down_m_s = Eigen::Vector3d::Zero();
  return tags;
}

Result<geodesy::LocalFrame> frame_of(const sim::Profile& profile) {
  return geodesy::LocalFrame::at(
      {profile.origin_latitude_deg, profile.origin_longitude_deg, profile.origin_height_m});
}

Status write_photo(const sim::World& world, const sim::Flight& flight, std::size_t index,
                   const geodesy::LocalFrame& frame, const fs::path& folder, int threads) {
  const sim::Shot& shot = flight.shots[index];
  const Image image = sim::photograph(world, flight, index, threads);
  const auto tagged = deliver::with_tags(jpeg::encode(image, flight.profile.jpeg_quality),
                                         tags_of(flight, shot, frame));
  if (!tagged) return tagged.error();
  return write_whole_file(folder / "photos" / shot.photo, *tagged);
}

Result<SimulatedFolder> fill(const sim::Flight& flight, const std::optional<Image>& ground_photo,
                             const fs::path& folder, int threads, const Progress& progress) {
  const auto frame = frame_of(flight.profile);
  if (!frame) return frame.error();
  progress("laying the ground", 0, 1);
  const sim::World world(sim::world_for(flight.profile, flight.seed, threads), ground_photo);
  progress("laying the ground", 1, 1);
  if (Status done = write_truth(world, flight, *frame, folder); !done) return done.error();
  const auto count = static_cast<int>(flight.shots.size());
  for (int k = 0; k < count; ++k) {
    progress("taking photos", k, count);
    const Status done =
        write_photo(world, flight, static_cast<std::size_t>(k), *frame, folder, threads);
    if (!done) return done.error();
  }
  progress("taking photos", count, count);
  return SimulatedFolder{count, static_cast<int>(world.targets().size())};
}

}  // namespace

Result<SimulatedFolder> write_simulated_flight(const sim::Flight& flight,
                                               const std::optional<Image>& ground_photo,
                                               const fs::path& folder, int threads,
                                               const Progress& progress) {
  return in_new_folder(folder,
                       [&] { return fill(flight, ground_photo, folder, threads, progress); });
}

}  // namespace plumbline::commands
