// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/result.h"

namespace plumbline::geodesy {

// Japan's plane rectangular coordinates, zones I to XIX (JGD2011, EPSG 6669 to 6687): transverse
// Mercator on GRS80, scale 0.9999 on the central meridian. As everywhere in Japan X IS NORTH and Y
// IS EAST. Source of the origins: Geospatial Information Authority of Japan, notice of 2002 no. 9.
struct PlaneRectangular {
  int zone = 0;  // 1..19
  double x_north_m = 0;
  double y_east_m = 0;
};

// The zone in which a place in Japan is mapped, chosen by the nearest origin among those whose part
// of the country reaches there; 0 outside Japan. On the border of two zones either is sensible: a
// survey that must be in a given zone names it.
int plane_rectangular_zone_of(double latitude_deg, double longitude_deg);

// Fails where the zone is not 1..19 or the place is farther than 10 degrees from its meridian.
Result<PlaneRectangular> plane_rectangular_of(double latitude_deg, double longitude_deg, int zone);

struct LatLon {
  double latitude_deg = 0;
  double longitude_deg = 0;
};
Result<LatLon> lat_lon_of(const PlaneRectangular& place);

// A zone as people write it: "9", "IX", "ix"; 0 where it is none of the nineteen.
int parse_plane_rectangular_zone(const std::string& text);
// "I" to "XIX".
std::string plane_rectangular_zone_name(int zone);

}  // namespace plumbline::geodesy
