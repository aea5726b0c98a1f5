// SPDX-License-Identifier: MIT
#include "edge/geodesy/plane_rectangular.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "edge/geodesy/utm.h"
#include "tests/edge/geodesy/proj_transform.h"

namespace plumbline::geodesy {
namespace {

struct Place {
  double latitude_deg;
  double longitude_deg;
};

// Near the origin of each zone, as the notice lists them (degrees and minutes).
constexpr Place kOrigins[19] = {{33, 129.5},
                                {33, 131},
                                {36, 132 + 10 / 60.},
                                {33, 133.5},
                                {36, 134 + 20 / 60.},
                                {36, 136},
                                {36, 137 + 10 / 60.},
                                {36, 138.5},
                                {36, 139 + 50 / 60.},
                                {40, 140 + 50 / 60.},
                                {44, 140.25},
                                {44, 142.25},
                                {44, 144.25},
                                {26, 142},
                                {26, 127.5},
                                {26, 124},
                                {26, 131},
                                {20, 136},
                                {26, 154}};

class EachZone : public ::testing::TestWithParam<int> {};

TEST_P(EachZone, AgreesWithProjToATenthOfAMillimetre) {
  const int zone = GetParam();
  const ProjTransform proj("EPSG:6668", "EPSG:" + std::to_string(6668 + zone));
  ASSERT_TRUE(proj.ok());
  const Place& origin = kOrigins[zone - 1];
  for (const double north : {-1.7, 0.0, 0.3, 1.1}) {
    for (const double east : {-1.4, 0.0, 0.2, 1.3}) {
      const double latitude = origin.latitude_deg + north;
      const double longitude = origin.longitude_deg + east;
      const auto ours = plane_rectangular_of(latitude, longitude, zone);
      ASSERT_TRUE(ours.ok());
      const PJ_COORD theirs = proj(latitude, longitude);
      EXPECT_NEAR(ours->x_north_m, theirs.xy.x, 1e-4);
      EXPECT_NEAR(ours->y_east_m, theirs.xy.y, 1e-4);
      const auto back = lat_lon_of(*ours);
      ASSERT_TRUE(back.ok());
      EXPECT_NEAR(back->latitude_deg, latitude, 1e-11);
      EXPECT_NEAR(back->longitude_deg, longitude, 1e-11);
    }
  }
}

TEST_P(EachZone, HasItsOriginAtZero) {
  const Place& origin = kOrigins[GetParam() - 1];
  const auto at = plane_rectangular_of(origin.latitude_deg, origin.longitude_deg, GetParam());
  ASSERT_TRUE(at.ok());
  EXPECT_NEAR(at->x_north_m, 0, 1e-7);
  EXPECT_NEAR(at->y_east_m, 0, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(PlaneRectangular, EachZone, ::testing::Range(1, 20));

// Along the central meridian x is 0.9999 times the meridian arc; east of it y is positive.
TEST(PlaneRectangular, XIsNorthAndYIsEast) {
  const auto north = plane_rectangular_of(36.1, 139 + 50 / 60., 9);
  // One tenth of a degree of the GRS80 meridian at 36.05 degrees is 11095.65 m, by
  // M = a (1 - e2) / (1 - e2 sin2)^1.5.
  const double e2 = 0.00669438002290;
  const double s = std::sin(36.05 * M_PI / 180);
  const double arc = 6378137 * (1 - e2) / std::pow(1 - e2 * s * s, 1.5) * 0.1 * M_PI / 180;
  EXPECT_NEAR(north->x_north_m, 0.9999 * arc, 0.01);
  EXPECT_NEAR(north->y_east_m, 0, 1e-7);
  const auto east = plane_rectangular_of(36, 139.9, 9);
  EXPECT_GT(east->y_east_m, 5900);
}

TEST(PlaneRectangular, ChoosesTheZoneOfThePrefecture) {
  const struct {
    const char* town;
    double latitude_deg, longitude_deg;
    int zone;
  } towns[] = {{"Nagasaki", 32.75, 129.88, 1},
               {"Amami", 28.37, 129.50, 1},
               {"Fukuoka", 33.59, 130.42, 2},
               {"Kagoshima", 31.56, 130.56, 2},
               {"Hiroshima", 34.39, 132.46, 3},
               {"Matsue", 35.47, 133.05, 3},
               {"Kochi", 33.56, 133.53, 4},
               {"Takamatsu", 34.34, 134.04, 4},
               {"Kobe", 34.69, 135.18, 5},
               {"Okayama", 34.66, 133.92, 5},
               {"Osaka", 34.69, 135.50, 6},
               {"Kyoto", 35.01, 135.77, 6},
               {"Nagoya", 35.17, 136.88, 7},
               {"Toyama", 36.70, 137.21, 7},
               {"Niigata", 37.92, 139.04, 8},
               {"Shizuoka", 34.97, 138.38, 8},
               {"Kofu", 35.66, 138.57, 8},
               {"Tokyo", 35.68, 139.76, 9},
               {"Odawara", 35.26, 139.15, 9},
               {"Hachijo", 33.10, 139.80, 9},
               {"Sendai", 38.27, 140.87, 10},
               {"Aomori", 40.82, 140.75, 10},
               {"Hakodate", 41.77, 140.73, 11},
               {"Sapporo", 43.06, 141.35, 12},
               {"Wakkanai", 45.42, 141.67, 12},
               {"Kushiro", 42.98, 144.38, 13},
               {"Lake Saroma", 44.12, 143.95, 13},
               {"Chichijima", 27.09, 142.19, 14},
               {"Naha", 26.21, 127.68, 15},
               {"Ishigaki", 24.34, 124.16, 16},
               {"Minamidaito", 25.83, 131.23, 17},
               {"Okinotorishima", 20.42, 136.08, 18},
               {"Minamitorishima", 24.29, 153.98, 19}};
  for (const auto& town : towns) {
    EXPECT_EQ(plane_rectangular_zone_of(town.latitude_deg, town.longitude_deg), town.zone)
        << town.town;
  }
}

TEST(PlaneRectangular, HasNoZoneOutsideJapan) {
  EXPECT_EQ(plane_rectangular_zone_of(35.18, 129.08), 0);  // Busan
  EXPECT_EQ(plane_rectangular_zone_of(25.03, 121.57), 0);  // Taipei
  EXPECT_EQ(plane_rectangular_zone_of(46.64, 142.76), 0);  // Korsakov
  EXPECT_EQ(plane_rectangular_zone_of(30.17, -98.09), 0);  // Texas
  EXPECT_EQ(plane_rectangular_zone_of(-36, -40), 0);
  EXPECT_EQ(plane_rectangular_zone_of(std::numeric_limits<double>::quiet_NaN(), 139), 0);
}

TEST(PlaneRectangular, UnderstandsZonesAsPeopleWriteThem) {
  EXPECT_EQ(parse_plane_rectangular_zone("9"), 9);
  EXPECT_EQ(parse_plane_rectangular_zone("IX"), 9);
  EXPECT_EQ(parse_plane_rectangular_zone("xix"), 19);
  EXPECT_EQ(parse_plane_rectangular_zone("20"), 0);
  EXPECT_EQ(parse_plane_rectangular_zone(""), 0);
  EXPECT_EQ(plane_rectangular_zone_name(9), "IX");
  EXPECT_EQ(plane_rectangular_zone_name(0), "");
}

TEST(PlaneRectangular, RefusesWhatIsNotInAZone) {
  EXPECT_FALSE(plane_rectangular_of(36, 139, 0).ok());
  EXPECT_FALSE(plane_rectangular_of(36, 100, 9).ok());
  EXPECT_FALSE(plane_rectangular_of(std::numeric_limits<double>::quiet_NaN(), 139, 9).ok());
  EXPECT_FALSE(lat_lon_of(PlaneRectangular{9, 1e9, 0}).ok());
  EXPECT_FALSE(lat_lon_of(PlaneRectangular{23, 0, 0}).ok());
}

TEST(Utm, AgreesWithProjInBothHemispheres) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const double latitude = -79 + 1e-3 * static_cast<double>(random() % 150000);
    const double longitude = -179.9 + 1e-3 * static_cast<double>(random() % 359000);
    const auto utm = utm_of(latitude, longitude);
    ASSERT_TRUE(utm.ok());
    const ProjTransform proj("EPSG:4326", "EPSG:" + std::to_string(utm->epsg()));
    const PJ_COORD theirs = proj(latitude, longitude);
    EXPECT_NEAR(utm->easting_m, theirs.xy.x, 1e-3) << latitude << " " << longitude;
    EXPECT_NEAR(utm->northing_m, theirs.xy.y, 1e-3);
    const auto back = lat_lon_of(*utm);
    EXPECT_NEAR(back->latitude_deg, latitude, 1e-9);
  }
}

TEST(Utm, StaysInTheZoneAskedForAcrossABorder) {
  const auto utm = utm_of(36, 144.01, 54, true);  // by itself it would be 55
  ASSERT_TRUE(utm.ok());
  EXPECT_EQ(utm->name(), "54N");
  EXPECT_GT(utm->easting_m, 770'000);
  const auto south = utm_of(0.001, 141, 54, false);
  EXPECT_NEAR(south->northing_m, 10'000'000 + 110.5, 0.5);
}

TEST(Utm, RefusesPolesAndNonsense) {
  EXPECT_FALSE(utm_of(89, 10).ok());
  EXPECT_FALSE(utm_of(91, 10).ok());
  EXPECT_FALSE(utm_of(std::numeric_limits<double>::quiet_NaN(), 10).ok());
  EXPECT_FALSE(utm_of(36, 140, 61, true).ok());
}

}  // namespace
}  // namespace plumbline::geodesy
