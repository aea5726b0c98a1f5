// SPDX-License-Identifier: MIT
#include "edge/geodesy/geoid.h"

#include <algorithm>
#include <cmath>

#include "edge/geodesy/geoid_reader.h"

namespace plumbline::geodesy {

Result<Geoid> Geoid::parse(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("P5")) return GeoidReader(name).read_pgm(text);
  constexpr std::size_t kWhereAHeadBegins = 20'000;
  if (text.substr(0, kWhereAHeadBegins).find("begin_of_head") != std::string_view::npos) {
    return GeoidReader(name).read_isg(text);
  }
  return Error{"'" + name +
               "' is not a geoid model; .pgm (as for GeographicLib) and ISG 2.0 text are read."};
}

double Geoid::node_m(int row, int column) const {
  const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column);
  return heights_m_[at];
}

Result<double> Geoid::undulation_m(double latitude_deg, double longitude_deg) const {
  const Error outside{"Latitude " + std::to_string(latitude_deg) + ", longitude " +
                      std::to_string(longitude_deg) + " lies outside the geoid model '" + name_ +
                      "'; give one that covers the place."};
  constexpr double kEdge = 1e-9;  // of a cell: a place on the border is inside
  const double y = (north_deg_ - latitude_deg) / step_lat_deg_;
  const double turn = 360 / step_lon_deg_;
  const double from_west = (longitude_deg - west_deg_) / step_lon_deg_;
  double x = from_west - turn * std::floor((from_west + kEdge) / turn);
  const double last_x = around_the_globe_ ? turn : columns_ - 1;
  if (!(y >= -kEdge && y <= rows_ - 1 + kEdge && x >= -kEdge && x <= last_x + kEdge))
    return outside;

  const int row = std::clamp(static_cast<int>(std::floor(y)), 0, rows_ - 2);
  const int last_column = around_the_globe_ ? columns_ - 1 : columns_ - 2;
  const int column = std::clamp(static_cast<int>(std::floor(x)), 0, last_column);
  const int east = (column + 1) % columns_;
  const double fy = std::clamp(y - row, 0.0, 1.0);
  const double fx = std::clamp(x - column, 0.0, 1.0);
  const double north_m = (1 - fx) * node_m(row, column) + fx * node_m(row, east);
  const double south_m = (1 - fx) * node_m(row + 1, column) + fx * node_m(row + 1, east);
  const double height_m = (1 - fy) * north_m + fy * south_m;
  if (std::isnan(height_m)) return outside;
  return height_m;
}

}  // namespace plumbline::geodesy
