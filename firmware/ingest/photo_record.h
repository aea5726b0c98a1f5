// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "edge/base/gnss_fix.h"

namespace plumbline::ingest {

// What a photo's EXIF and XMP say, in our units. What they do not say is empty.

enum class HeightKind { kUnknown, kEllipsoidal, kSeaLevel };

// Which solution the receiver had: drone-dji:RtkFlag, or nothing said.
enum class PhotoFix { kNotSaid, kNone, kSingle, kFloat, kFixed };

struct PhotoPosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  std::optional<double> height_m;
  HeightKind height_kind = HeightKind::kUnknown;
  PhotoFix fix = PhotoFix::kNotSaid;
  // East, north, up; RtkStd* or GPSXYAccuracy and GPSZAccuracy.
  std::optional<Eigen::Vector3d> sigma_enu_m;
  std::optional<double> height_above_start_m;  // drone-dji:RelativeAltitude
};

// As DJI defines them: yaw of the camera's forward direction from north, clockwise; pitch 0 level,
// -90 straight down; roll positive where the right side is low.
struct GimbalAttitude {
  std::optional<double> yaw_deg;
  double pitch_deg = 0;
  double roll_deg = 0;
};

struct PhotoTime {
  // The camera's clock as shown, to SubSecTimeOriginal: civil time of an unknown zone unless
  // `offset` is there. Stored as if it were UTC.
  std::optional<UtcTime> camera_clock;
  bool has_subseconds = false;
  std::optional<std::chrono::minutes> offset;  // camera clock minus UTC, OffsetTimeOriginal
  std::optional<UtcTime> gps;                  // GPSDateStamp and GPSTimeStamp
};

// UTC of the exposure: by the stated offset; else by the offset to the GPS time, where that is
// within 10 s of a whole quarter of an hour; else the GPS time itself; else empty.
std::optional<UtcTime> utc_of(const PhotoTime& time);

struct PhotoRecord {
  std::string name;  // file name with extension
  std::filesystem::path path;
  std::string sha256;
  std::size_t bytes = 0;  // of the file
  int width_px = 0;
  int height_px = 0;
  std::string make;
  std::string model;
  std::optional<double> focal_length_mm;
  std::optional<double> focal_length_35mm;
  std::optional<double> focal_plane_px_per_mm;  // along u, of the stored image
  double digital_zoom = 1;
  std::optional<PhotoPosition> position;
  std::optional<GimbalAttitude> gimbal;
  std::optional<Eigen::Vector3d>
      velocity_in_enu_m_s;  // drone-dji:Flight[XYZ]Speed is north, east, down
  PhotoTime time;
};

}  // namespace plumbline::ingest
