// SPDX-License-Identifier: MIT
#include "edge/geodesy/utm.h"

#include <GeographicLib/UTMUPS.hpp>
#include <exception>

namespace plumbline::geodesy {
namespace {

using GeographicLib::UTMUPS;

Error no_utm(const std::string& why) {
  return {"These coordinates have no UTM equivalent (" + why + "); use geographic ones."};
}

Result<Utm> utm_in(double latitude_deg, double longitude_deg, int set_zone) {
  try {
    Utm utm;
    UTMUPS::Forward(latitude_deg, longitude_deg, utm.zone, utm.north, utm.easting_m, utm.northing_m,
                    set_zone);
    if (utm.zone < UTMUPS::MINUTMZONE) return no_utm("the place is near a pole or not a number");
    return utm;
  } catch (const std::exception& error) {
    return no_utm(error.what());
  }
}

}  // namespace

std::string Utm::name() const { return std::to_string(zone) + (north ? "N" : "S"); }

Result<Utm> utm_of(double latitude_deg, double longitude_deg) {
  return utm_in(latitude_deg, longitude_deg, UTMUPS::STANDARD);
}

Result<Utm> utm_of(double latitude_deg, double longitude_deg, int zone, bool north) {
  if (zone < UTMUPS::MINUTMZONE || zone > UTMUPS::MAXUTMZONE) {
    return Error{"UTM zone " + std::to_string(zone) + " does not exist; zones run from 1 to 60."};
  }
  Result<Utm> utm = utm_in(latitude_deg, longitude_deg, zone);
  if (!utm || utm->north == north) return utm;
  constexpr double kFalseNorthingOfTheSouthM = 10'000'000;
  utm->northing_m += north ? -kFalseNorthingOfTheSouthM : kFalseNorthingOfTheSouthM;
  utm->north = north;
  return utm;
}

Result<LatLon> lat_lon_of(const Utm& place) {
  try {
    LatLon result;
    UTMUPS::Reverse(place.zone, place.north, place.easting_m, place.northing_m, result.latitude_deg,
                    result.longitude_deg);
    return result;
  } catch (const std::exception& error) {
    return no_utm(error.what());
  }
}

}  // namespace plumbline::geodesy
