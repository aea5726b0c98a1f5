// SPDX-License-Identifier: MIT
#include "edge/geodesy/plane_rectangular.h"

#include <GeographicLib/Math.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <array>
#include <cmath>

namespace plumbline::geodesy {
namespace {

constexpr int kZones = 19;
constexpr double kSemiMajorAxisM = 6378137;        // GRS80
constexpr double kFlattening = 1 / 298.257222101;  // GRS80
constexpr double kScale = 0.9999;
constexpr double kMaxFromMeridianDeg = 10;  // the widest use is 2; the series is exact to 35

struct Origin {
  const char* name;
  double latitude_deg;
  double longitude_deg;
};
constexpr double at(double degrees, double minutes) { return degrees + minutes / 60; }
constexpr std::array<Origin, kZones> kOrigins = {{{"I", 33, at(129, 30)},
                                                  {"II", 33, 131},
                                                  {"III", 36, at(132, 10)},
                                                  {"IV", 33, at(133, 30)},
                                                  {"V", 36, at(134, 20)},
                                                  {"VI", 36, 136},
                                                  {"VII", 36, at(137, 10)},
                                                  {"VIII", 36, at(138, 30)},
                                                  {"IX", 36, at(139, 50)},
                                                  {"X", 40, at(140, 50)},
                                                  {"XI", 44, at(140, 15)},
                                                  {"XII", 44, at(142, 15)},
                                                  {"XIII", 44, at(144, 15)},
                                                  {"XIV", 26, 142},
                                                  {"XV", 26, at(127, 30)},
                                                  {"XVI", 26, 124},
                                                  {"XVII", 26, 131},
                                                  {"XVIII", 20, 136},
                                                  {"XIX", 26, 154}}};

const GeographicLib::TransverseMercator& projection() {
  static const GeographicLib::TransverseMercator kProjection(kSemiMajorAxisM, kFlattening, kScale);
  return kProjection;
}

const Origin& origin_of(int zone) { return kOrigins[static_cast<std::size_t>(zone - 1)]; }

double northing_of_origin_m(const Origin& origin) {
  double x = 0;
  double y = 0;
  projection().Forward(0, origin.latitude_deg, 0, x, y);
  return y;
}

Status check_zone(int zone) {
  if (zone >= 1 && zone <= kZones) return Done{};
  return Error{"Plane rectangular zone " + std::to_string(zone) +
               " does not exist; zones run from 1 (I) to 19 (XIX)."};
}

}  // namespace

Result<PlaneRectangular> plane_rectangular_of(double latitude_deg, double longitude_deg, int zone) {
  if (const Status known = check_zone(zone); !known) return known.error();
  const Origin& origin = origin_of(zone);
  const double from_meridian_deg =
      GeographicLib::Math::AngDiff(origin.longitude_deg, longitude_deg);
  if (!(std::abs(from_meridian_deg) <= kMaxFromMeridianDeg) || !(std::abs(latitude_deg) <= 90)) {
    return Error{"Latitude " + std::to_string(latitude_deg) + ", longitude " +
                 std::to_string(longitude_deg) + " is too far from plane rectangular zone " +
                 origin.name + "; choose the zone of that place."};
  }
  PlaneRectangular result{zone, 0, 0};
  projection().Forward(origin.longitude_deg, latitude_deg, longitude_deg, result.y_east_m,
                       result.x_north_m);
  result.x_north_m -= northing_of_origin_m(origin);
  return result;
}

Result<LatLon> lat_lon_of(const PlaneRectangular& place) {
  if (const Status known = check_zone(place.zone); !known) return known.error();
  const Origin& origin = origin_of(place.zone);
  constexpr double kFarthestM = 3e6;
  if (!(std::abs(place.x_north_m) < kFarthestM && std::abs(place.y_east_m) < kFarthestM / 3)) {
    return Error{"Plane rectangular coordinates x " + std::to_string(place.x_north_m) + ", y " +
                 std::to_string(place.y_east_m) + " m lie outside zone " + origin.name +
                 "; x is north and y is east, in metres."};
  }
  LatLon result;
  projection().Reverse(origin.longitude_deg, place.y_east_m,
                       place.x_north_m + northing_of_origin_m(origin), result.latitude_deg,
                       result.longitude_deg);
  return result;
}

std::string plane_rectangular_zone_name(int zone) {
  return zone >= 1 && zone <= kZones ? origin_of(zone).name : "";
}

int parse_plane_rectangular_zone(const std::string& text) {
  std::string upper;
  for (const char c : text) upper += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  for (int zone = 1; zone <= kZones; ++zone) {
    if (upper == origin_of(zone).name || upper == std::to_string(zone)) return zone;
  }
  return 0;
}

}  // namespace plumbline::geodesy
