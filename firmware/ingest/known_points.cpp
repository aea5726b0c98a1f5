// SPDX-License-Identifier: MIT
#include <set>
#include <utility>

#include "edge/geodesy/plane_rectangular.h"
#include "firmware/ingest/csv_table.h"
#include "firmware/ingest/named_points.h"
#include "firmware/ingest/table_reader.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

using geodesy::Geodetic;
using geodesy::LatLon;

// One row after another of control.csv or check.csv.
class KnownPointReader {
 public:
  KnownPointReader(const CsvTable& table, const GroundFrame& ground)
      : table_(table), reader_(table), ground_(ground) {
    reader_.require({"point"});
    has_enu_ = reader_.has_all({"e_m", "n_m", "u_m"});
    has_lat_lon_ = reader_.has_all({"lat_deg", "lon_deg"});
    has_plane_ = reader_.has_all({"x_north_m", "y_east_m", "zone"});
    has_height_ = reader_.has("height_ellipsoidal_m");
    has_height_ = reader_.has("height_orthometric_m") || has_height_;
  }

  bool on_earth() const { return (has_lat_lon_ || has_plane_) && has_height_; }

  Status check_columns() {
    if (reader_.error()) return *reader_.error();
    if (has_enu_ || on_earth()) return Done{};
    return Error{at_line(table_.name, table_.header_line) +
                 "the columns of a position are missing: e_m,n_m,u_m, or lat_deg,lon_deg or "
                 "x_north_m,y_east_m,zone with height_ellipsoidal_m or height_orthometric_m."};
  }

  Result<KnownPoint> read(const CsvRow& row) {
    KnownPoint known;
    known.point = reader_.text(row, "point");
    known.in_enu_m = position(row);
    known.sigma_m = sigma(row);
    if (!reader_.error() && !seen_.insert(known.point).second) {
      reader_.fail(row, "the point " + in_quotes(known.point) + " is there twice.");
    }
    if (reader_.error()) return *reader_.error();
    return known;
  }

  // Empty where the row does not say; a fault is kept in the reader.
  std::optional<Geodetic> place(const CsvRow& row) {
    const std::optional<LatLon> horizontal = lat_lon(row);
    if (!horizontal) return std::nullopt;
    const std::optional<double> height_m = height(row, *horizontal);
    if (!height_m) return std::nullopt;
    return Geodetic{horizontal->latitude_deg, horizontal->longitude_deg, *height_m};
  }

  const std::optional<Error>& error() const { return reader_.error(); }
  std::vector<std::string> notices() const { return reader_.notices(); }

 private:
  Eigen::Vector3d position(const CsvRow& row) {
    if (ground_.frame != nullptr && !ground_.three_points && on_earth()) {
      if (const std::optional<Geodetic> found = place(row)) return ground_.frame->enu_of(*found);
    }
    const auto e = reader_.number_or_blank(row, "e_m");
    const auto n = reader_.number_or_blank(row, "n_m");
    const auto u = reader_.number_or_blank(row, "u_m");
    if (e && n && u) return {*e, *n, *u};
    reader_.fail(row,
                 on_earth() && ground_.three_points
                     ? "the position is on the earth, but the results are in the frame of three "
                       "points (frame.csv); give e_m,n_m,u_m in that frame."
                 : on_earth() && ground_.frame == nullptr
                     ? "the position is on the earth, but nothing else here is: the photos "
                       "have no positions on the earth to set a local frame; give e_m,n_m,u_m."
                     : "the position is not complete.");
    return Eigen::Vector3d::Zero();
  }

  std::optional<LatLon> lat_lon(const CsvRow& row) {
    const auto latitude = reader_.number_or_blank(row, "lat_deg");
    const auto longitude = reader_.number_or_blank(row, "lon_deg");
    if (latitude && longitude) {
      if (*latitude >= -90 && *latitude <= 90 && *longitude >= -180 && *longitude <= 360) {
        return LatLon{*latitude, *longitude};
      }
      reader_.fail(row, "latitude and longitude are not a place on the earth.");
      return std::nullopt;
    }
    const auto x_north_m = reader_.number_or_blank(row, "x_north_m");
    const auto y_east_m = reader_.number_or_blank(row, "y_east_m");
    if (!x_north_m || !y_east_m) return std::nullopt;
    const std::string zone_text = reader_.text(row, "zone");
    const int zone = geodesy::parse_plane_rectangular_zone(zone_text);
    if (zone == 0) {
      reader_.fail(row, "the zone " + in_quotes(zone_text) +
                            " is none of Japan's plane rectangular zones, 1 (I) to 19 (XIX).");
      return std::nullopt;
    }
    const Result<LatLon> found = geodesy::lat_lon_of({zone, *x_north_m, *y_east_m});
    if (!found) reader_.fail(row, found.error().sentence);
    return found ? std::optional(*found) : std::nullopt;
  }

  std::optional<double> height(const CsvRow& row, const LatLon& at) {
    if (const auto ellipsoidal = reader_.number_or_blank(row, "height_ellipsoidal_m")) {
      return in_range(row, *ellipsoidal);
    }
    const auto orthometric = reader_.number_or_blank(row, "height_orthometric_m");
    if (!orthometric) return std::nullopt;
    if (ground_.geoid == nullptr) {
      reader_.fail(row,
                   "the height is orthometric; give the geoid that it refers to with --geoid.");
      return std::nullopt;
    }
    const auto undulation = ground_.geoid->undulation_m(at.latitude_deg, at.longitude_deg);
    if (!undulation) reader_.fail(row, undulation.error().sentence);
    return undulation ? in_range(row, *orthometric + *undulation) : std::nullopt;
  }

  std::optional<double> in_range(const CsvRow& row, double height_m) {
    if (height_m > -12e3 && height_m < 20e3) return height_m;
    reader_.fail(row, "the height is not one of a place on the earth.");
    return std::nullopt;
  }

  std::optional<Eigen::Vector3d> sigma(const CsvRow& row) {
    const auto e = reader_.sigma_or_blank(row, "sigma_e_m");
    const auto n = reader_.sigma_or_blank(row, "sigma_n_m");
    const auto u = reader_.sigma_or_blank(row, "sigma_u_m");
    if (e && n && u) return Eigen::Vector3d(*e, *n, *u);
    if (e || n || u) {
      reader_.fail(row, "give all three of sigma_e_m, sigma_n_m and sigma_u_m, or none.");
    }
    return std::nullopt;
  }

  const CsvTable& table_;
  TableReader reader_;
  GroundFrame ground_;
  bool has_enu_ = false;
  bool has_lat_lon_ = false;
  bool has_plane_ = false;
  bool has_height_ = false;
  std::set<std::string> seen_;
};

}  // namespace

Result<KnownPoints> read_known_points(const std::filesystem::path& path,
                                      const GroundFrame& ground) {
  const Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  KnownPointReader reader(*table, ground);
  if (const Status columns = reader.check_columns(); !columns) return columns.error();
  KnownPoints result;
  for (const CsvRow& row : table->rows) {
    Result<KnownPoint> known = reader.read(row);
    if (!known) return known.error();
    result.points.push_back(*std::move(known));
  }
  if (result.points.empty()) {
    return Error{table->name + ": there are no points in it; add some, or do without the file."};
  }
  result.notices = reader.notices();
  return result;
}

Result<std::optional<Geodetic>> first_place(const std::filesystem::path& path,
                                            const geodesy::Geoid* geoid) {
  const Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  KnownPointReader reader(*table, GroundFrame{nullptr, geoid});
  if (const Status columns = reader.check_columns(); !columns) return columns.error();
  for (const CsvRow& row : table->rows) {
    const std::optional<Geodetic> place = reader.place(row);
    if (reader.error()) return *reader.error();
    if (place) return place;
  }
  return std::optional<Geodetic>();
}

std::vector<survey::NamedControl> as_control(const KnownPoints& known) {
  std::vector<survey::NamedControl> control;
  for (const KnownPoint& point : known.points) {
    const Eigen::Vector3d sigma_m =
        point.sigma_m.value_or(Eigen::Vector3d::Constant(kControlSigmaM));
    control.push_back({point.point, point.in_enu_m, sigma_m.cwiseAbs2().asDiagonal()});
  }
  return control;
}

std::vector<survey::CheckPoint> as_check_points(const KnownPoints& known) {
  std::vector<survey::CheckPoint> check;
  for (const KnownPoint& point : known.points) {
    check.push_back({point.point, point.in_enu_m, point.sigma_m.value_or(Eigen::Vector3d::Zero())});
  }
  return check;
}

}  // namespace plumbline::ingest
