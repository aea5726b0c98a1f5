// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>

#include "firmware/ingest/number.h"
#include "firmware/ingest/photo_tags.h"
#include "firmware/ingest/text_file.h"
#include "firmware/ingest/time_tags.h"

namespace plumbline::ingest {
namespace {

std::string text_of(const Tags& tags, std::string_view key) {
  const auto found = tags.find(key);
  return found == tags.end() ? "" : std::string(trimmed(found->second));
}

std::optional<double> number_of(const Tags& tags, std::string_view key) {
  const auto found = tags.find(key);
  return found == tags.end() ? std::nullopt : tag_number(found->second);
}

// Degrees, minutes, seconds as three rationals, and the letter of the half.
std::optional<double> angle_of(const Tags& tags, const std::string& key, const char* negative) {
  const std::vector<double> parts = tag_numbers(text_of(tags, key));
  if (parts.empty() || parts.size() > 3) return std::nullopt;
  double degrees = 0;
  for (std::size_t i = parts.size(); i > 0; --i) degrees = degrees / 60 + parts[i - 1];
  const bool turned = text_of(tags, key + "Ref").starts_with(negative);
  return turned ? -degrees : degrees;
}

bool has_word(std::string text, const char* word) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.find(word) != std::string::npos;
}

PhotoFix fix_of(const Tags& tags) {
  const std::optional<double> flag = number_of(tags, "Xmp.drone-dji.RtkFlag");
  // DJI, Mavic 3 user manual: 0 none, 16 single, 32 to 49 float, 50 fixed.
  if (!flag) return PhotoFix::kNotSaid;
  if (*flag >= 50) return PhotoFix::kFixed;
  if (*flag >= 32) return PhotoFix::kFloat;
  return *flag >= 1 ? PhotoFix::kSingle : PhotoFix::kNone;
}

std::optional<Eigen::Vector3d> sigma_of(const Tags& tags) {
  const auto plausible = [](const std::optional<double>& sigma) {
    constexpr double kMostM = 1000;
    return sigma && *sigma > 0 && *sigma < kMostM;
  };
  const auto east = number_of(tags, "Xmp.drone-dji.RtkStdLon");
  const auto north = number_of(tags, "Xmp.drone-dji.RtkStdLat");
  const auto up = number_of(tags, "Xmp.drone-dji.RtkStdHgt");
  if (plausible(east) && plausible(north) && plausible(up)) {
    return Eigen::Vector3d(*east, *north, *up);
  }
  const auto plan = number_of(tags, "Xmp.Camera.GPSXYAccuracy");
  const auto height = number_of(tags, "Xmp.Camera.GPSZAccuracy");
  if (plausible(plan) && plausible(height)) return Eigen::Vector3d(*plan, *plan, *height);
  return std::nullopt;
}

struct Height {
  std::optional<double> metres;
  HeightKind kind = HeightKind::kUnknown;
};

// EXIF 2 says "sea level" for GPSAltitudeRef 0 and 1, whatever the writer meant. EXIF 3 gives these
// to ellipsoidal heights and 2 and 3 to sea level; GPSMapDatum may say more.
Height exif_height(const Tags& tags) {
  Height height{number_of(tags, "Exif.GPSInfo.GPSAltitude"), HeightKind::kUnknown};
  const double reference = number_of(tags, "Exif.GPSInfo.GPSAltitudeRef").value_or(0);
  if (height.metres && (reference == 1 || reference == 3)) height.metres = -*height.metres;
  if (has_word(text_of(tags, "Exif.GPSInfo.GPSMapDatum"), "ellips")) {
    height.kind = HeightKind::kEllipsoidal;
  } else if (reference >= 2) {
    height.kind = HeightKind::kSeaLevel;
  }
  return height;
}

// The three entries of an RTK drone carry more digits than EXIF's rationals often do.
void prefer_drone_position(const Tags& tags, PhotoPosition& position) {
  const auto latitude = number_of(tags, "Xmp.drone-dji.GpsLatitude");
  auto longitude = number_of(tags, "Xmp.drone-dji.GpsLongitude");
  if (!longitude) longitude = number_of(tags, "Xmp.drone-dji.GpsLongtitude");  // as early firmware
  if (latitude && longitude) {
    position.latitude_deg = *latitude;
    position.longitude_deg = *longitude;
  }
  const auto height = number_of(tags, "Xmp.drone-dji.AbsoluteAltitude");
  if (height) position.height_m = height;
  position.height_kind = HeightKind::kEllipsoidal;
}

std::optional<PhotoPosition> position_of(const Tags& tags) {
  const auto latitude = angle_of(tags, "Exif.GPSInfo.GPSLatitude", "S");
  const auto longitude = angle_of(tags, "Exif.GPSInfo.GPSLongitude", "W");
  const bool in_xmp = tags.contains("Xmp.drone-dji.GpsLatitude");
  if ((!latitude || !longitude) && !in_xmp) return std::nullopt;
  PhotoPosition position;
  position.latitude_deg = latitude.value_or(0);
  position.longitude_deg = longitude.value_or(0);
  const Height height = exif_height(tags);
  position.height_m = height.metres;
  position.height_kind = height.kind;
  position.fix = fix_of(tags);
  if (position.fix != PhotoFix::kNotSaid) {
    prefer_drone_position(tags, position);
  } else if (!latitude || !longitude) {
    const HeightKind kind = position.height_kind;
    prefer_drone_position(tags, position);
    position.height_kind = kind;
  }
  position.sigma_enu_m = sigma_of(tags);
  position.height_above_start_m = number_of(tags, "Xmp.drone-dji.RelativeAltitude");
  return position;
}

// Why a position cannot be one; empty where it can.
std::string fault_of(const Tags& tags, const PhotoPosition& position) {
  if (text_of(tags, "Exif.GPSInfo.GPSStatus") == "V") return "the receiver had no fix";
  if (!(std::abs(position.latitude_deg) <= 90 && std::abs(position.longitude_deg) <= 180)) {
    return "it is no place on the earth";
  }
  if (position.latitude_deg == 0 && position.longitude_deg == 0) return "it is 0 N, 0 E";
  return "";
}

void take_position(const Tags& tags, PhotoRecord& record, std::vector<std::string>& warnings) {
  std::optional<PhotoPosition> position = position_of(tags);
  if (!position) return;
  if (const std::string fault = fault_of(tags, *position); !fault.empty()) {
    warnings.push_back("The position in photo " + in_quotes(record.name) +
                       " was not used: " + fault + ".");
    return;
  }
  constexpr double kHighestM = 20e3;
  if (position->height_m && !(std::abs(*position->height_m) < kHighestM)) {
    warnings.push_back("The height in photo " + in_quotes(record.name) +
                       " was not used: " + shortest(*position->height_m) + " m cannot be.");
    position->height_m.reset();
  }
  record.position = position;
}

std::optional<GimbalAttitude> gimbal_of(const Tags& tags) {
  const auto pitch = number_of(tags, "Xmp.drone-dji.GimbalPitchDegree");
  const auto usual = [](double degrees) { return std::abs(degrees) <= 360; };
  if (!pitch || !usual(*pitch)) return std::nullopt;
  GimbalAttitude gimbal;
  gimbal.pitch_deg = *pitch;
  gimbal.roll_deg = number_of(tags, "Xmp.drone-dji.GimbalRollDegree").value_or(0);
  gimbal.yaw_deg = number_of(tags, "Xmp.drone-dji.GimbalYawDegree");
  if (!usual(gimbal.roll_deg)) return std::nullopt;
  if (gimbal.yaw_deg && !usual(*gimbal.yaw_deg)) gimbal.yaw_deg.reset();
  return gimbal;
}

// DJI's axes of flight speed are north, east, down.
std::optional<Eigen::Vector3d> velocity_of(const Tags& tags) {
  const auto north = number_of(tags, "Xmp.drone-dji.FlightXSpeed");
  const auto east = number_of(tags, "Xmp.drone-dji.FlightYSpeed");
  const auto down = number_of(tags, "Xmp.drone-dji.FlightZSpeed");
  if (!north || !east || !down) return std::nullopt;
  const Eigen::Vector3d velocity(*east, *north, -*down);
  constexpr double kFastestMS = 200;
  return velocity.norm() < kFastestMS ? std::optional(velocity) : std::nullopt;
}

std::optional<double> positive(const std::optional<double>& value, double most) {
  return value && *value > 0 && *value < most ? value : std::nullopt;
}

// FocalPlaneXResolution counts pixels of the photo as taken; a photo made smaller since has fewer.
std::optional<double> focal_plane_px_per_mm(const Tags& tags, int width_px) {
  const auto per_unit = positive(number_of(tags, "Exif.Photo.FocalPlaneXResolution"), 1e7);
  if (!per_unit) return std::nullopt;
  double unit_mm = 25.4;  // EXIF's default: inch
  switch (static_cast<int>(number_of(tags, "Exif.Photo.FocalPlaneResolutionUnit").value_or(2))) {
    case 3:
      unit_mm = 10;
      break;
    case 4:
      unit_mm = 1;
      break;
    case 5:
      unit_mm = 0.001;
      break;
    default:
      break;
  }
  const auto taken_px = positive(number_of(tags, "Exif.Photo.PixelXDimension"), 1e6);
  const double smaller = taken_px ? width_px / *taken_px : 1;
  return positive(*per_unit / unit_mm * smaller, 1e5);
}

}  // namespace

void interpret(const Tags& tags, PhotoRecord& record, std::vector<std::string>& warnings) {
  record.make = text_of(tags, "Exif.Image.Make");
  record.model = text_of(tags, "Exif.Image.Model");
  record.focal_length_mm = positive(number_of(tags, "Exif.Photo.FocalLength"), 5000);
  record.focal_length_35mm = positive(number_of(tags, "Exif.Photo.FocalLengthIn35mmFilm"), 5000);
  record.focal_plane_px_per_mm = focal_plane_px_per_mm(tags, record.width_px);
  record.digital_zoom =
      std::max(1.0, positive(number_of(tags, "Exif.Photo.DigitalZoomRatio"), 100).value_or(1));
  take_position(tags, record, warnings);
  record.gimbal = gimbal_of(tags);
  record.velocity_in_enu_m_s = velocity_of(tags);
  record.time = time_of(tags);
}

}  // namespace plumbline::ingest
