// SPDX-License-Identifier: MIT
#include "sim/truth.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "sim/random.h"

namespace plumbline::sim {
namespace {

constexpr std::uint64_t kPickStream = 0x91C5;
constexpr double kSurfaceCell_m = 0.5;

// printf into a string; the formats here stay far below its buffer.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char buffer[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

std::string origin_line(const geodesy::LocalFrame& frame) {
  const geodesy::Geodetic origin = frame.origin();
  return text(
      "# local ENU with its origin at lat_deg %.9f, lon_deg %.9f, height_ellipsoidal_m %.4f\n",
      origin.latitude_deg, origin.longitude_deg, origin.height_ellipsoidal_m);
}

std::string enu_and_geodetic(const Eigen::Vector3d& place_m, const geodesy::LocalFrame& frame) {
  const geodesy::Geodetic place = frame.geodetic_of(place_m);
  return text("%.5f,%.5f,%.5f,%.11f,%.11f,%.5f", place_m.x(), place_m.y(), place_m.z(),
              place.latitude_deg, place.longitude_deg, place.height_ellipsoidal_m);
}

}  // namespace

std::string photos_csv(const Flight& flight, const geodesy::LocalFrame& frame) {
  std::string csv = "# the camera as it was at each exposure\n" + origin_line(frame);
  csv +=
      "photo,e_m,n_m,u_m,lat_deg,lon_deg,height_ellipsoidal_m,omega_deg,phi_deg,kappa_deg,time_s\n";
  for (const Shot& shot : flight.shots) {
    const auto angles = geometry::angles_of(shot.pose.ground_from_photo);
    csv += shot.photo + "," + enu_and_geodetic(shot.pose.centre_m, frame);
    csv += text(",%.7f,%.7f,%.7f,%.3f\n", angles.omega_rad * kDegPerRad,
                angles.phi_rad * kDegPerRad, angles.kappa_rad * kDegPerRad, shot.time_s);
  }
  return csv;
}

std::string picks_csv(const World& world, const Flight& flight) {
  Random random(flight.seed, kPickStream);
  const double sigma_px = flight.profile.pick_sigma_px;
  std::string csv = text("# true centres of the targets plus noise of %g px\n", sigma_px);
  csv += sigma_px > 0 ? "photo,point,u_px,v_px,sigma_px\n" : "photo,point,u_px,v_px\n";
  for (std::size_t k = 0; k < flight.shots.size(); ++k) {
    for (const Target& target : world.targets()) {
      const auto pixel = seen_at(world, flight, k, target);
      if (!pixel) continue;
      const double u_px = pixel->x() + sigma_px * random.normal();
      const double v_px = pixel->y() + sigma_px * random.normal();
      csv +=
          text("%s,%s,%.4f,%.4f", flight.shots[k].photo.c_str(), target.name.c_str(), u_px, v_px);
      csv += sigma_px > 0 ? text(",%g\n", sigma_px) : "\n";
    }
  }
  return csv;
}

std::string check_csv(const World& world, const geodesy::LocalFrame& frame) {
  std::string csv = "# true centres of the targets\n" + origin_line(frame);
  csv += "point,e_m,n_m,u_m,lat_deg,lon_deg,height_ellipsoidal_m\n";
  for (const Target& target : world.targets()) {
    csv += target.name + "," + enu_and_geodetic(target.centre_m, frame) + "\n";
  }
  return csv;
}

std::string surface_asc(const World& world, double half_extent_m) {
  const int side = static_cast<int>(2 * half_extent_m / kSurfaceCell_m);
  const double corner_m = -0.5 * side * kSurfaceCell_m;
  std::string grid = text(
      "ncols %d\nnrows %d\nxllcorner %g\nyllcorner %g\ncellsize %g\n"
      "NODATA_value -9999\n",
      side, side, corner_m, corner_m, kSurfaceCell_m);
  for (int row = side - 1; row >= 0; --row) {  // from the north
    for (int column = 0; column < side; ++column) {
      const double e = corner_m + (column + 0.5) * kSurfaceCell_m;
      const double n = corner_m + (row + 0.5) * kSurfaceCell_m;
      grid += text(column == 0 ? "%.4f" : " %.4f", world.terrain().height_m(e, n));
    }
    grid += "\n";
  }
  return grid;
}

}  // namespace plumbline::sim
