// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "firmware/deliver/georeference.h"
#include "firmware/deliver/html.h"
#include "firmware/deliver/reliance.h"
#include "firmware/deliver/report_tables.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

// As many decimals as sigmas of this size deserve.
int sigma_decimals(const Eigen::Vector3d& median_m) {
  const double smallest = median_m.minCoeff();
  return smallest < 0.02 ? 4 : smallest < 1.0 ? 3 : 2;
}

int sigma_decimals(const Product& product, const std::vector<int>& points) {
  const auto figures = sigma_figures(product, points);
  return figures ? sigma_decimals(figures->median) : 3;
}

std::vector<int> first_rows(const std::vector<int>& points) {
  return {points.begin(),
          points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), kMostRows))};
}

std::string cut_note(std::size_t all) {
  if (all <= kMostRows) return {};
  return "The first " + std::to_string(kMostRows) + " of " + std::to_string(all) +
         " points; all of them are in points.csv.";
}

std::string trust_words(Trust trust) {
  switch (trust) {
    case Trust::kFixed:
      return "\xe2\x9c\x93 good";
    case Trust::kRelativeOnly:
      return "\xe2\x96\xb3 relative only";
    case Trust::kNotFixed:
      break;
  }
  return "\xe2\x9c\x95 not observable";
}

const std::string& name_of(const Product& product, int i) {
  return product.problem.point_names[static_cast<std::size_t>(i)];
}

Row ring_row(const Ring& ring) {
  const std::string reach = ring.to_m > 1e8
                                ? "beyond " + fixed(ring.from_m, 0)
                                : fixed(ring.from_m, 0) + "\xe2\x80\x93" + fixed(ring.to_m, 0);
  Row row = {reach + " m", std::to_string(ring.points)};
  add_axes(row, ring.median_sigma_m, 3);
  add_axes(row, ring.median_local_sigma_m.value_or(Eigen::Vector3d::Constant(std::nan(""))), 3);
  return row;
}

Row check_total(const std::string& name, const Eigen::Vector3d& total,
                const std::optional<Eigen::Vector3d>& best_fit) {
  Row row = {name};
  add_axes(row, total, 3);
  row.insert(row.end(), 3, "");
  if (best_fit)
    add_axes(row, *best_fit, 3);
  else
    row.insert(row.end(), 3, "");
  return row;
}

}  // namespace

std::string reliance_table(const Product& product) {
  Table table;
  table.head = {"What", "Sigma", "Rests on", "Verdict", "What it means"};
  table.text_columns = 5;
  for (const Reliance& r : reliances(product))
    table.rows.push_back({r.quantity, r.sigma, r.rests_on, trust_words(r.trust), r.meaning});
  return html_table(table);
}

std::string ring_table(const Product& product) {
  Table table;
  table.caption = "Median standard deviation by distance from the foot of the climb";
  table.head = {"Distance",     "Points",    kSigma + "E|m", kSigma + "N|m",
                kSigma + "U|m", "shape E|m", "shape N|m",    "shape U|m"};
  table.note =
      "All measured points. \"Shape\": position, turn, tilt and scale of the whole set "
      "aside, as they are where only distances and forms within the area matter.";
  for (const Ring& ring : rings(product)) table.rows.push_back(ring_row(ring));
  return html_table(table);
}

std::string check_table(const survey::CheckReport& check) {
  Table table;
  table.caption = "Differences at the check points (measured minus known)";
  table.head = {"Point",        "E|m",          "N|m",          "U|m",          kSigma + "E|m",
                kSigma + "N|m", kSigma + "U|m", "best fit E|m", "best fit N|m", "best fit U|m"};
  for (const survey::CheckedPoint& point : check.points) {
    if (table.rows.size() == kMostRows) {
      table.note = "More are in check.csv.";
      break;
    }
    Row row = {point.point};
    add_axes(row, point.difference_m, 3);
    add_axes(row, point.sigma_m, 3);
    const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::nan(""));
    add_axes(row, check.best_fit_rmse_m ? point.best_fit_difference_m : unknown, 3);
    table.rows.push_back(row);
  }
  table.total_rows = 2;
  table.rows.push_back(check_total("RMSE", check.rmse_m, check.best_fit_rmse_m));
  table.rows.push_back(check_total("RMS of \xcf\x83", check.rms_stated_sigma_m, std::nullopt));
  return html_table(table);
}

std::string named_point_table(const Product& product) {
  const std::vector<int> named = point_kinds(product).named;
  const int decimals = sigma_decimals(product, named);
  Table table;
  table.caption = product.solution.frame
                      ? "Named points; E, N, U are X, Y, Z of the frame of three of them"
                      : "Named points, local frame (east, north, up)";
  table.head = {"Point",        "E|m",          "N|m",  "U|m",   kSigma + "E|m",
                kSigma + "N|m", kSigma + "U|m", "Rays", "RMS|px"};
  table.note = cut_note(named.size());
  for (const int i : first_rows(named)) {
    const orient::MeasuredPoint& point = point_of(product, i);
    Row row = {name_of(product, i)};
    add_axes(row, point.in_enu_m, 3);
    add_axes(row, point.covariance_m2.diagonal().cwiseSqrt(), decimals);
    row.push_back(std::to_string(point.rays));
    row.push_back(fixed(point.residual_rms_px, 2));
    table.rows.push_back(row);
  }
  return html_table(table);
}

std::string map_coordinate_table(const Product& product) {
  const auto earth = Georeference::of(product);
  if (!earth || !*earth) return {};
  const std::vector<int> named = point_kinds(product).named;
  Table table;
  const std::string grid = (*earth)->grid_in_words();
  table.caption = "Named points on the map: " + (grid.empty() ? "no grid near a pole" : grid);
  table.head = {"Point",        "X north|m",    "Y east|m", "Ellipsoidal height|m",
                "Latitude|deg", "Longitude|deg"};
  table.note = cut_note(named.size());
  for (const int i : first_rows(named)) {
    const auto place = (*earth)->place_of(point_of(product, i).in_enu_m);
    if (!place) continue;
    table.rows.push_back({name_of(product, i), fixed(place->x_north_m, 3),
                          fixed(place->y_east_m, 3), fixed(place->geodetic.height_ellipsoidal_m, 3),
                          fixed(place->geodetic.latitude_deg, 8),
                          fixed(place->geodetic.longitude_deg, 8)});
  }
  return html_table(table);
}

}  // namespace plumbline::deliver
