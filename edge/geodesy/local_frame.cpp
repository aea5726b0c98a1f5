// SPDX-License-Identifier: MIT
#include "edge/geodesy/local_frame.h"

#include <cmath>
#include <string>

#include "edge/base/units.h"

namespace plumbline::geodesy {
namespace {

bool is_place(const Geodetic& place) {
  return std::abs(place.latitude_deg) <= 90 && std::abs(place.longitude_deg) <= 360 &&
         place.height_ellipsoidal_m >= -12e3 && place.height_ellipsoidal_m <= 100e3;
}

// Columns: east, north and up of a place, in the earth's frame (Hofmann-Wellenhof et al. 2008,
// GNSS, eq. 8.6). Not by GeographicLib, whose matrices are vectors: this is asked for while a photo
// is aimed at, where nothing may wait for memory.
Eigen::Matrix3d ecef_from_enu(const Geodetic& place) {
  const double sin_latitude = std::sin(place.latitude_deg * kRadPerDeg);
  const double cos_latitude = std::cos(place.latitude_deg * kRadPerDeg);
  const double sin_longitude = std::sin(place.longitude_deg * kRadPerDeg);
  const double cos_longitude = std::cos(place.longitude_deg * kRadPerDeg);
  Eigen::Matrix3d turn;
  turn.col(0) << -sin_longitude, cos_longitude, 0;
  turn.col(1) << -sin_latitude * cos_longitude, -sin_latitude * sin_longitude, cos_latitude;
  turn.col(2) << cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude;
  return turn;
}

}  // namespace

LocalFrame::LocalFrame(const Geodetic& origin)
    : frame_(origin.latitude_deg, origin.longitude_deg, origin.height_ellipsoidal_m) {}

Result<LocalFrame> LocalFrame::at(const Geodetic& origin) {
  if (!is_place(origin)) {
    return Error{"The origin of the local frame, latitude " + std::to_string(origin.latitude_deg) +
                 ", longitude " + std::to_string(origin.longitude_deg) + ", height " +
                 std::to_string(origin.height_ellipsoidal_m) +
                 " m, is not a place on the earth; check the positions given."};
  }
  return LocalFrame(origin);
}

Geodetic LocalFrame::origin() const {
  return {frame_.LatitudeOrigin(), frame_.LongitudeOrigin(), frame_.HeightOrigin()};
}

Eigen::Vector3d LocalFrame::enu_of(const Geodetic& place) const {
  Eigen::Vector3d enu;
  frame_.Forward(place.latitude_deg, place.longitude_deg, place.height_ellipsoidal_m, enu.x(),
                 enu.y(), enu.z());
  return enu;
}

Geodetic LocalFrame::geodetic_of(const Eigen::Vector3d& in_enu_m) const {
  Geodetic place;
  frame_.Reverse(in_enu_m.x(), in_enu_m.y(), in_enu_m.z(), place.latitude_deg, place.longitude_deg,
                 place.height_ellipsoidal_m);
  return place;
}

Eigen::Matrix3d LocalFrame::enu_from_enu_at(const Geodetic& place) const {
  return ecef_from_enu(origin()).transpose() * ecef_from_enu(place);
}

}  // namespace plumbline::geodesy
