// SPDX-License-Identifier: MIT
#include "firmware/deliver/photo_writer.h"

#include <cmath>
#include <cstdio>
#include <exiv2/exiv2.hpp>
#include <fstream>
#include <mutex>
#include <system_error>

namespace plumbline::deliver {
namespace {

using Exiv2::URational;

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

URational rational(double value, std::uint32_t denominator) {
  return {static_cast<std::uint32_t>(std::llround(value * denominator)), denominator};
}

Exiv2::URationalValue rationals(const std::vector<URational>& parts) {
  Exiv2::URationalValue value;
  value.value_ = parts;
  return value;
}

// Degrees, minutes, seconds to 1e-7 of a second (3 micrometres of ground).
Exiv2::URationalValue sexagesimal(double degrees) {
  constexpr std::int64_t kPerSecond = 10'000'000;
  const std::int64_t parts = std::llround(std::abs(degrees) * 3600 * kPerSecond);
  const std::int64_t minutes = parts / (60 * kPerSecond);
  return rationals({{static_cast<std::uint32_t>(minutes / 60), 1},
                    {static_cast<std::uint32_t>(minutes % 60), 1},
                    {static_cast<std::uint32_t>(parts % (60 * kPerSecond)), kPerSecond}});
}

struct CivilTime {
  std::chrono::year_month_day date;
  std::chrono::hh_mm_ss<std::chrono::microseconds> clock;
};

CivilTime civil(UtcTime time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  return {std::chrono::year_month_day(day),
          std::chrono::hh_mm_ss<std::chrono::microseconds>(time - day)};
}

std::string date_text(const CivilTime& time) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%04d:%02u:%02u", static_cast<int>(time.date.year()),
                static_cast<unsigned>(time.date.month()), static_cast<unsigned>(time.date.day()));
  return buffer;
}

std::string clock_text(const CivilTime& time) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%02d:%02d:%02d",
                static_cast<int>(time.clock.hours().count()),
                static_cast<int>(time.clock.minutes().count()),
                static_cast<int>(time.clock.seconds().count()));
  return buffer;
}

std::string offset_text(std::chrono::minutes offset) {
  const auto minutes = static_cast<int>(offset.count());
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%c%02d:%02d", minutes < 0 ? '-' : '+',
                std::abs(minutes) / 60, std::abs(minutes) % 60);
  return buffer;
}

void put_time(Exiv2::ExifData& exif, const PhotoTags& tags) {
  const CivilTime local = civil(tags.time + tags.utc_offset);
  const std::string moment = date_text(local) + " " + clock_text(local);
  char fraction[16];
  std::snprintf(fraction, sizeof fraction, "%03d",
                static_cast<int>(local.clock.subseconds().count() / 1000));
  exif["Exif.Image.DateTime"] = moment;
  exif["Exif.Photo.DateTimeOriginal"] = moment;
  exif["Exif.Photo.DateTimeDigitized"] = moment;
  exif["Exif.Photo.SubSecTimeOriginal"] = std::string(fraction);
  exif["Exif.Photo.OffsetTimeOriginal"] = offset_text(tags.utc_offset);
}

void put_camera(Exiv2::ExifData& exif, const PhotoTags& tags) {
  exif["Exif.Image.Make"] = tags.make;
  exif["Exif.Image.Model"] = tags.model;
  exif["Exif.Image.Orientation"] = std::uint16_t{1};
  exif["Exif.Photo.PixelXDimension"] = static_cast<std::uint32_t>(tags.width_px);
  exif["Exif.Photo.PixelYDimension"] = static_cast<std::uint32_t>(tags.height_px);
  if (tags.focal_length_mm) {
    exif["Exif.Photo.FocalLength"] = rational(*tags.focal_length_mm, 10000);
  }
  if (!tags.pixel_pitch_um) return;
  const double pixels_per_cm = 1e4 / *tags.pixel_pitch_um;
  exif["Exif.Photo.FocalPlaneXResolution"] = rational(pixels_per_cm, 10000);
  exif["Exif.Photo.FocalPlaneYResolution"] = rational(pixels_per_cm, 10000);
  exif["Exif.Photo.FocalPlaneResolutionUnit"] = std::uint16_t{3};  // centimetre
  if (!tags.focal_length_mm) return;
  // CIPA DC-008: by the diagonal, 43.27 mm on 24 mm x 36 mm film.
  const double diagonal_mm =
      std::hypot(tags.width_px, tags.height_px) * *tags.pixel_pitch_um * 1e-3;
  exif["Exif.Photo.FocalLengthIn35mmFilm"] =
      static_cast<std::uint16_t>(std::lround(*tags.focal_length_mm * 43.2666 / diagonal_mm));
}

void put_gps(Exiv2::ExifData& exif, const PhotoTags& tags) {
  const PhotoPosition& place = *tags.position;
  const std::string group = "Exif.GPSInfo.";
  const auto put = [&](const char* key, const Exiv2::Value& value) {
    exif.add(Exiv2::ExifKey(group + key), &value);
  };
  exif[group + "GPSLatitudeRef"] = std::string(place.latitude_deg < 0 ? "S" : "N");
  put("GPSLatitude", sexagesimal(place.latitude_deg));
  exif[group + "GPSLongitudeRef"] = std::string(place.longitude_deg < 0 ? "W" : "E");
  put("GPSLongitude", sexagesimal(place.longitude_deg));
  Exiv2::DataValue below(Exiv2::unsignedByte);
  below.read(place.height_ellipsoidal_m < 0 ? "1" : "0");
  put("GPSAltitudeRef", below);
  exif[group + "GPSAltitude"] = rational(std::abs(place.height_ellipsoidal_m), 10000);
  exif[group + "GPSMapDatum"] = std::string("WGS-84");
  const CivilTime utc = civil(tags.time);
  exif[group + "GPSDateStamp"] = date_text(utc);
  const auto count = [](auto duration) { return static_cast<std::uint32_t>(duration.count()); };
  put("GPSTimeStamp",
      rationals(
          {{count(utc.clock.hours()), 1},
           {count(utc.clock.minutes()), 1},
           {count(utc.clock.seconds()) * 1000 + count(utc.clock.subseconds()) / 1000, 1000}}));
}

void put_xmp(Exiv2::XmpData& xmp, const PhotoTags& tags) {
  const auto put = [&](const char* key, const std::string& value) {
    xmp[std::string("Xmp.drone-dji.") + key] = value;
  };
  if (tags.position) {
    put("AbsoluteAltitude", text("%+.4f", tags.position->height_ellipsoidal_m));
    put("GpsLatitude", text("%.11f", tags.position->latitude_deg));
    put("GpsLongitude", text("%.11f", tags.position->longitude_deg));
    if (tags.position->rtk_flag) put("RtkFlag", std::to_string(*tags.position->rtk_flag));
    if (const auto& sigma_m = tags.position->sigma_m) {
      put("RtkStdLon", text("%.5f", sigma_m->x()));
      put("RtkStdLat", text("%.5f", sigma_m->y()));
      put("RtkStdHgt", text("%.5f", sigma_m->z()));
    }
  }
  const auto put_given = [&](const char* key, const char* format,
                             const std::optional<double>& value) {
    if (value) put(key, text(format, *value));
  };
  put_given("RelativeAltitude", "%+.2f", tags.height_above_start_m);
  put_given("GimbalYawDegree", "%+.1f", tags.gimbal_yaw_deg);
  put_given("GimbalPitchDegree", "%+.2f", tags.gimbal_pitch_deg);
  put_given("GimbalRollDegree", "%+.2f", tags.gimbal_roll_deg);
  if (const auto& velocity = tags.velocity_north_east_down_m_s) {
    put("FlightXSpeed", text("%+.2f", velocity->x()));
    put("FlightYSpeed", text("%+.2f", velocity->y()));
    put("FlightZSpeed", text("%+.2f", velocity->z()));
  }
}

void know_drone_namespace() {
  static std::once_flag known;
  std::call_once(known, [] {
    Exiv2::XmpParser::initialize();
    Exiv2::XmpProperties::registerNs("http://www.dji.com/drone-dji/1.0/", "drone-dji");
  });
}

}  // namespace

Result<std::vector<std::uint8_t>> with_tags(std::span<const std::uint8_t> jpeg,
                                            const PhotoTags& tags) {
  try {
    know_drone_namespace();
    const auto image = Exiv2::ImageFactory::open(jpeg.data(), static_cast<long>(jpeg.size()));
    Exiv2::ExifData exif;
    put_camera(exif, tags);
    put_time(exif, tags);
    if (tags.position) put_gps(exif, tags);
    Exiv2::XmpData xmp;
    put_xmp(xmp, tags);
    image->setExifData(exif);
    image->setXmpData(xmp);
    image->writeMetadata();
    Exiv2::BasicIo& io = image->io();
    const Exiv2::byte* first = io.mmap();
    std::vector<std::uint8_t> bytes(first, first + io.size());
    io.munmap();
    return bytes;
  } catch (const std::exception& error) {
    return Error{std::string("the photo's tags cannot be written: ") + error.what() + "."};
  }
}

Status write_whole_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::filesystem::path unfinished = path;
  unfinished += ".part";
  std::error_code trouble;
  {
    std::ofstream file(unfinished, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) trouble = std::error_code(errno, std::generic_category());
  }
  if (!trouble) std::filesystem::rename(unfinished, path, trouble);
  if (!trouble) return Done{};
  std::error_code ignored;
  std::filesystem::remove(unfinished, ignored);
  return Error{path.string() + " cannot be written: " + trouble.message() + "."};
}

Status write_whole_file(const std::filesystem::path& path, const std::string& text) {
  return write_whole_file(
      path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace plumbline::deliver
