// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "edge/base/result.h"
#include "edge/geodesy/local_frame.h"
#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// A point of the local frame on the earth, and in the map grid of the product: near a pole, beyond
// UTM, there is none, the zone is empty and both coordinates are NaN.
struct MapPlace {
  geodesy::Geodetic geodetic;
  std::string zone;  // "IX", or "54N" (UTM)
  double x_north_m = 0;
  double y_east_m = 0;
};

// Turns the local frame of a product into places on the earth; one map zone for the whole.
class Georeference {
 public:
  // Empty where the product has no origin. Fails where the origin is no place on the earth or the
  // zone asked for is not 1..19.
  static Result<std::optional<Georeference>> of(const Product& product);

  // Fails where the point is too far away for the zone.
  Result<MapPlace> place_of(const Eigen::Vector3d& in_enu_m) const;

  // "Japan plane rectangular zone IX (X north, Y east)", "UTM zone 54N"; empty where there is none.
  std::string grid_in_words() const;

 private:
  Georeference(geodesy::LocalFrame frame, int plane_zone, int utm_zone, bool north);
  Result<MapPlace> plane_place(const geodesy::Geodetic& geodetic) const;
  Result<MapPlace> utm_place(const geodesy::Geodetic& geodetic) const;

  geodesy::LocalFrame frame_;
  int plane_zone_;  // 0: UTM
  int utm_zone_;    // 0: none
  bool north_;
};

}  // namespace plumbline::deliver
