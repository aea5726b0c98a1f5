// SPDX-License-Identifier: MIT
#include "firmware/deliver/georeference.h"

#include <cmath>
#include <utility>

#include "edge/geodesy/plane_rectangular.h"
#include "edge/geodesy/utm.h"

namespace plumbline::deliver {
namespace {

constexpr int kNoZone = 0;  // UTM ends at 80 degrees south and 84 degrees north

}  // namespace

Georeference::Georeference(geodesy::LocalFrame frame, int plane_zone, int utm_zone, bool north)
    : frame_(std::move(frame)), plane_zone_(plane_zone), utm_zone_(utm_zone), north_(north) {}

Result<std::optional<Georeference>> Georeference::of(const Product& product) {
  if (!product.origin) return std::optional<Georeference>{};
  const GeoOrigin& origin = *product.origin;
  auto frame = geodesy::LocalFrame::at(
      {origin.latitude_deg, origin.longitude_deg, origin.height_ellipsoidal_m});
  if (!frame) return frame.error();
  const int asked = product.plane_rectangular_zone;
  const int plane_zone =
      asked != 0 ? asked
                 : geodesy::plane_rectangular_zone_of(origin.latitude_deg, origin.longitude_deg);
  if (plane_zone != 0)
    return std::optional<Georeference>(Georeference(*std::move(frame), plane_zone, 0, true));
  const auto utm = geodesy::utm_of(origin.latitude_deg, origin.longitude_deg);
  return std::optional<Georeference>(Georeference(*std::move(frame), 0, utm ? utm->zone : kNoZone,
                                                  utm ? utm->north : origin.latitude_deg > 0));
}

Result<MapPlace> Georeference::place_of(const Eigen::Vector3d& in_enu_m) const {
  const geodesy::Geodetic geodetic = frame_.geodetic_of(in_enu_m);
  return plane_zone_ != 0 ? plane_place(geodetic) : utm_place(geodetic);
}

Result<MapPlace> Georeference::plane_place(const geodesy::Geodetic& geodetic) const {
  const auto plane =
      geodesy::plane_rectangular_of(geodetic.latitude_deg, geodetic.longitude_deg, plane_zone_);
  if (!plane) return plane.error();
  return MapPlace{geodetic, geodesy::plane_rectangular_zone_name(plane_zone_), plane->x_north_m,
                  plane->y_east_m};
}

Result<MapPlace> Georeference::utm_place(const geodesy::Geodetic& geodetic) const {
  if (utm_zone_ == kNoZone) return MapPlace{geodetic, "", std::nan(""), std::nan("")};
  const auto utm =
      geodesy::utm_of(geodetic.latitude_deg, geodetic.longitude_deg, utm_zone_, north_);
  if (!utm) return utm.error();
  return MapPlace{geodetic, utm->name(), utm->northing_m, utm->easting_m};
}

std::string Georeference::grid_in_words() const {
  if (plane_zone_ != 0)
    return "Japan plane rectangular zone " + geodesy::plane_rectangular_zone_name(plane_zone_) +
           " (X north, Y east)";
  if (utm_zone_ == kNoZone) return {};
  return "UTM zone " + std::to_string(utm_zone_) + (north_ ? "N" : "S");
}

}  // namespace plumbline::deliver
