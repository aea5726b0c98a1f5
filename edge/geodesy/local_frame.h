// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <GeographicLib/LocalCartesian.hpp>

#include "edge/base/result.h"

namespace plumbline::geodesy {

// A place on the earth: WGS84 ellipsoid (GRS80 differs from it by less than 0.1 mm in height).
struct Geodetic {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_ellipsoidal_m = 0;
};

// The local ground frame: x east, y north, z up along the ellipsoid's normal at the origin, metres.
// A tangent plane, so heights fall away from it by d^2 / 2R (0.8 mm at 100 m, 78 mm at 1 km).
// Exact to nanometres (GeographicLib::LocalCartesian).
class LocalFrame {
 public:
  // Fails where the origin is not a finite place with latitude in [-90, 90], longitude in
  // [-360, 360] and height in [-12 km, 100 km].
  static Result<LocalFrame> at(const Geodetic& origin);

  Geodetic origin() const;
  Eigen::Vector3d enu_of(const Geodetic& place) const;
  Geodetic geodetic_of(const Eigen::Vector3d& in_enu_m) const;

  // Turns vectors of the ENU frame at `place` (in which a receiver states sigmas and covariances)
  // into this frame; nearly the identity within a few kilometres.
  Eigen::Matrix3d enu_from_enu_at(const Geodetic& place) const;

 private:
  explicit LocalFrame(const Geodetic& origin);
  GeographicLib::LocalCartesian frame_;
};

}  // namespace plumbline::geodesy
