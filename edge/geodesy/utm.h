// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/result.h"
#include "edge/geodesy/plane_rectangular.h"

namespace plumbline::geodesy {

// Universal transverse Mercator on WGS84 (EPSG 326zz north, 327zz south).
struct Utm {
  int zone = 0;  // 1..60
  bool north = true;
  double easting_m = 0;
  double northing_m = 0;

  std::string name() const;  // "54N"
  int epsg() const { return (north ? 32600 : 32700) + zone; }
};

// In the standard zone of the place; fails beyond 84 degrees north and 80 south.
Result<Utm> utm_of(double latitude_deg, double longitude_deg);
// In a given zone and hemisphere, so that a survey across a border stays in one.
Result<Utm> utm_of(double latitude_deg, double longitude_deg, int zone, bool north);
Result<LatLon> lat_lon_of(const Utm& place);

}  // namespace plumbline::geodesy
