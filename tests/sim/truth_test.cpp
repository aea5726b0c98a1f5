// SPDX-License-Identifier: MIT
#include "sim/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "small_flight.h"

namespace plumbline::sim {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<std::string> header;
  std::vector<Row> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, ',');) fields.push_back(field);
    if (header.empty()) {
      header = fields;
      continue;
    }
    Row row;
    for (std::size_t k = 0; k < fields.size(); ++k) row[header[k]] = fields[k];
    rows.push_back(row);
  }
  return rows;
}

double number(const Row& row, const std::string& key) { return std::stod(row.at(key)); }

// Latitude, longitude (degrees) and height on WGS84 to ECEF, by the closed formula.
Eigen::Vector3d ecef_m(double latitude_deg, double longitude_deg, double height_m) {
  const double a = 6378137.0, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double lat = latitude_deg * std::numbers::pi / 180;
  const double lon = longitude_deg * std::numbers::pi / 180;
  const double n = a / std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
  return {(n + height_m) * std::cos(lat) * std::cos(lon),
          (n + height_m) * std::cos(lat) * std::sin(lon),
          (n * (1 - e2) + height_m) * std::sin(lat)};
}

class Truth : public testing::Test {
 protected:
  Flight flight = fly(small_profile(), 8);
  World world{world_for(small_profile(), 8, 2), std::nullopt};
  geodesy::LocalFrame frame = geodesy::LocalFrame::at({35.36, 139.13, 120}).value();
};

TEST_F(Truth, GivesTargetsTheSamePlaceInEnuAndOnTheEarth) {
  const double lat = 35.36 * std::numbers::pi / 180, lon = 139.13 * std::numbers::pi / 180;
  Eigen::Matrix3d enu_from_ecef;
  enu_from_ecef << -std::sin(lon), std::cos(lon), 0,                                  //
      -std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat),  //
      std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat);
  const auto rows = rows_of(check_csv(world, frame));
  ASSERT_EQ(rows.size(), world.targets().size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::Vector3d enu_m(number(rows[k], "e_m"), number(rows[k], "n_m"),
                                number(rows[k], "u_m"));
    const Eigen::Vector3d on_earth_m =
        ecef_m(number(rows[k], "lat_deg"), number(rows[k], "lon_deg"),
               number(rows[k], "height_ellipsoidal_m"));
    const Eigen::Vector3d from_earth_m = enu_from_ecef * (on_earth_m - ecef_m(35.36, 139.13, 120));
    EXPECT_LT((enu_m - from_earth_m).norm(), 3e-5);
    EXPECT_LT((enu_m - world.targets()[k].centre_m).norm(), 2e-5);
  }
}

TEST_F(Truth, PicksTargetsWithTheNoiseStated) {
  double squares = 0;
  int count = 0;
  for (const Row& row : rows_of(picks_csv(world, flight))) {
    const auto photo = static_cast<std::size_t>(std::stoi(row.at("photo")) - 1);
    const auto target = static_cast<std::size_t>(std::stoi(row.at("point").substr(1)) - 1);
    const auto pixel = seen_at(world, flight, photo, world.targets()[target]);
    ASSERT_TRUE(pixel);
    squares += std::pow(number(row, "u_px") - pixel->x(), 2);
    squares += std::pow(number(row, "v_px") - pixel->y(), 2);
    EXPECT_EQ(row.at("sigma_px"), "0.1");
    count += 2;
  }
  ASSERT_GT(count, 40);
  EXPECT_NEAR(squares / count, 0.01, 0.01 * 5 * std::sqrt(2.0 / count));
}

TEST_F(Truth, WritesTheAnglesOfTheRotationThatRendered) {
  for (std::size_t k = 0; k < flight.shots.size(); ++k) {
    const Row row = rows_of(photos_csv(flight, frame))[k];
    const double w = number(row, "omega_deg") * std::numbers::pi / 180;
    const double p = number(row, "phi_deg") * std::numbers::pi / 180;
    const double q = number(row, "kappa_deg") * std::numbers::pi / 180;
    Eigen::Matrix3d rx, ry, rz;
    rx << 1, 0, 0, 0, std::cos(w), -std::sin(w), 0, std::sin(w), std::cos(w);
    ry << std::cos(p), 0, std::sin(p), 0, 1, 0, -std::sin(p), 0, std::cos(p);
    rz << std::cos(q), -std::sin(q), 0, std::sin(q), std::cos(q), 0, 0, 0, 1;
    EXPECT_LT((rx * ry * rz - flight.shots[k].pose.ground_from_photo).norm(), 1e-8);
  }
}

TEST_F(Truth, HoldsTheGroundFromNorthToSouth) {
  std::istringstream grid(surface_asc(world, 10));
  std::string word;
  for (int k = 0; k < 12; ++k) grid >> word;
  std::vector<double> heights_m;
  for (double height_m; grid >> height_m;) heights_m.push_back(height_m);
  ASSERT_EQ(heights_m.size(), 1600u);
  EXPECT_NEAR(heights_m[0], world.terrain().height_m(-9.75, 9.75), 1e-4);
  EXPECT_NEAR(heights_m[39], world.terrain().height_m(9.75, 9.75), 1e-4);
  EXPECT_NEAR(heights_m[1599], world.terrain().height_m(9.75, -9.75), 1e-4);
}

}  // namespace
}  // namespace plumbline::sim
