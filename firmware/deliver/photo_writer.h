// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "edge/base/gnss_fix.h"
#include "edge/base/result.h"

namespace plumbline::deliver {

// Where a photo was taken, as drones write it: EXIF GPS and XMP of the namespace drone-dji.
struct PhotoPosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_ellipsoidal_m = 0;
  std::optional<int> rtk_flag;             // 0 none, 16 single, 34 float, 50 fixed
  std::optional<Eigen::Vector3d> sigma_m;  // east, north, up: RtkStdLon, RtkStdLat, RtkStdHgt
};

struct PhotoTags {
  std::string make;
  std::string model;
  UtcTime time{};                     // of the exposure
  std::chrono::minutes utc_offset{};  // local time minus UTC
  int width_px = 0;
  int height_px = 0;
  std::optional<double> focal_length_mm;
  std::optional<double> pixel_pitch_um;  // with it, the size of the sensor is told
  std::optional<PhotoPosition> position;
  std::optional<double> height_above_start_m;
  // Gimbal: azimuth of the top of the photo from north clockwise; pitch -90 looks straight down.
  std::optional<double> gimbal_yaw_deg;
  std::optional<double> gimbal_pitch_deg;
  std::optional<double> gimbal_roll_deg;
  std::optional<Eigen::Vector3d> velocity_north_east_down_m_s;
};

// `jpeg` with the tags put in; the compressed pixels stay as they are. Coordinates are kept to
// 1e-9 degree and 0.1 mm. The same input gives the same bytes. Fails where `jpeg` is no JPEG.
Result<std::vector<std::uint8_t>> with_tags(std::span<const std::uint8_t> jpeg,
                                            const PhotoTags& tags);

// Writes a file as a whole: first under a temporary name beside it, then moved. On failure nothing
// is left behind.
Status write_whole_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
Status write_whole_file(const std::filesystem::path& path, const std::string& text);

}  // namespace plumbline::deliver
