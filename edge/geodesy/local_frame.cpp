// SPDX-License-Identifier: MIT
#include "edge/geodesy/local_frame.h"

#include <cmath>
#include <string>
#include <vector>

namespace plumbline::geodesy {
namespace {

bool is_place(const Geodetic& place) {
  return std::abs(place.latitude_deg) <= 90 && std::abs(place.longitude_deg) <= 360 &&
         place.height_ellipsoidal_m >= -12e3 && place.height_ellipsoidal_m <= 100e3;
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
  Eigen::Vector3d unused;
  std::vector<double> row_major(9);
  frame_.Forward(place.latitude_deg, place.longitude_deg, place.height_ellipsoidal_m, unused.x(),
                 unused.y(), unused.z(), row_major);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major.data());
}

}  // namespace plumbline::geodesy
