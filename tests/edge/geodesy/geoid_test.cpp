// SPDX-License-Identifier: MIT
#include "edge/geodesy/geoid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/Geoid.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

namespace plumbline::geodesy {
namespace {

using ::testing::HasSubstr;

Result<Geoid> parse(const std::string& text) {
  return Geoid::parse({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "g.x");
}

// The whole globe at 10 degrees: 36 columns, 19 rows, some smooth figure in steps of 3 mm.
std::string globe_pgm() {
  std::string text =
      "P5\n# Geoid file in PGM format for the GeographicLib::Geoid class\n"
      "# Description made up, 10-minute grid\n# DateTime 2020-01-01 00:00:00\n"
      "# MaxBilinearError 1\n# RMSBilinearError 1\n# MaxCubicError 1\n# RMSCubicError 1\n"
      "# Offset -108\n# Scale 0.003\n# Origin 90N 0E\n# AREA_OR_POINT Point\n"
      "# Vertical_Datum WGS84\n36 19\n65535\n";
  for (int row = 0; row < 19; ++row) {
    for (int column = 0; column < 36; ++column) {
      const double height_m = 40 * std::cos(0.3 * row) * std::sin(0.5 * column + row);
      const auto value = static_cast<unsigned>(std::lround((height_m + 108) / 0.003));
      text += static_cast<char>(value >> 8);
      text += static_cast<char>(value & 255);
    }
  }
  return text;
}

TEST(Geoid, InterpolatesAPgmAsGeographicLibDoesBilinearly) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "plumbline_geoid_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "made-up.pgm", std::ios::binary) << globe_pgm();
  const GeographicLib::Geoid theirs("made-up", folder.string(), false);
  const auto ours = parse(globe_pgm());
  ASSERT_TRUE(ours.ok()) << ours.error().sentence;
  std::mt19937 random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    const double latitude = -90 + 1e-3 * static_cast<double>(random() % 180001);
    const double longitude = -180 + 1e-3 * static_cast<double>(random() % 540001);
    const auto height = ours->undulation_m(latitude, longitude);
    ASSERT_TRUE(height.ok()) << latitude << " " << longitude;
    EXPECT_NEAR(*height, theirs(latitude, longitude), 1e-4) << latitude << " " << longitude;
  }
  std::filesystem::remove_all(folder);
}

// A plane is interpolated exactly: 37 + 0.5 (lat - 30) - 0.25 (lon - 140).
double plane_m(double latitude, double longitude) {
  return 37 + 0.5 * (latitude - 30) - 0.25 * (longitude - 140);
}

std::string isg(const std::string& limits, double north, double west, double step_lat,
                double step_lon, int rows, int columns) {
  std::string text =
      "Some words about the model\nbegin_of_head ================================\n"
      "model name     : MADE UP 2024\nmodel year     : 2024\ndata type      : geoid\n"
      "data units     : meters\ndata format    : grid\ndata ordering  : N-to-S, W-to-E\n"
      "ref ellipsoid  : GRS80\ncoord type     : geodetic\n" +
      limits + "nrows          = " + std::to_string(rows) +
      "\nncols          = " + std::to_string(columns) +
      "\nnodata         = -9999.0000\nISG format     =        2.0\nend_of_head ===============\n";
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      char cell[32];
      std::snprintf(cell, sizeof cell, " %10.4f",
                    plane_m(north - row * step_lat, west + column * step_lon));
      text += cell;
    }
    text += "\n";
  }
  return text;
}

// Steps of 1' by 1'30" as in Japan's model.
std::string japanese_isg() {
  return isg(
      "coord units    : dms\nlat min        =  30°00'00\"\nlat max        =  30°05'00\"\n"
      "lon min        = 140°00'00\"\nlon max        = 140°06'00\"\n"
      "delta lat      =   0°01'00\"\ndelta lon      =   0°01'30\"\n",
      30 + 5 / 60., 140, 1 / 60., 1.5 / 60, 6, 5);
}

TEST(Geoid, ReadsIsgWithDegreesMinutesSeconds) {
  const auto geoid = parse(japanese_isg());
  ASSERT_TRUE(geoid.ok()) << geoid.error().sentence;
  for (const auto& [latitude, longitude] :
       {std::pair{30.0, 140.0}, {30.0833333, 140.1}, {30.0123, 140.0777}, {30.05, 140.05}}) {
    const auto height = geoid->undulation_m(latitude, longitude);
    ASSERT_TRUE(height.ok());
    EXPECT_NEAR(*height, plane_m(latitude, longitude), 1e-4);
  }
}

TEST(Geoid, ReadsIsgWhoseLimitsAreThoseOfCells) {
  const auto geoid =
      parse(isg("lat min = 29.95\nlat max = 30.55\nlon min = 139.95\nlon max = 140.45\n"
                "delta lat = 0.1\ndelta lon = 0.1\n",
                30.5, 140, 0.1, 0.1, 6, 5));
  ASSERT_TRUE(geoid.ok()) << geoid.error().sentence;
  EXPECT_NEAR(*geoid->undulation_m(30.23, 140.31), plane_m(30.23, 140.31), 1e-4);
}

TEST(Geoid, GivesNothingOutsideItsGridOrWhereItHasAHole) {
  const auto geoid = parse(japanese_isg());
  EXPECT_FALSE(geoid->undulation_m(29.99, 140.05).ok());
  EXPECT_FALSE(geoid->undulation_m(30.05, 140.2).ok());
  EXPECT_FALSE(geoid->undulation_m(30.05, -40).ok());
  EXPECT_FALSE(geoid->undulation_m(std::nan(""), 140.05).ok());
  std::string holed = japanese_isg();
  const std::size_t first = holed.find('\n', holed.find("end_of_head")) + 1;
  holed.replace(first, 11, " -9999.0000");
  const auto with_hole = parse(holed);
  ASSERT_TRUE(with_hole.ok());
  EXPECT_FALSE(with_hole->undulation_m(30 + 4.5 / 60, 140.01).ok());
  EXPECT_TRUE(with_hole->undulation_m(30.01, 140.07).ok());
}

TEST(Geoid, ExplainsWhatIsWrongWithAFile) {
  const auto text = parse("hello");
  ASSERT_FALSE(text.ok());
  EXPECT_THAT(text.error().sentence, HasSubstr("'g.x' is not a geoid model"));
  const auto cut = parse(japanese_isg().substr(0, 900));
  ASSERT_FALSE(cut.ok());
  EXPECT_THAT(cut.error().sentence, HasSubstr("cut short"));
  const auto half = parse(globe_pgm().substr(0, 800));
  ASSERT_FALSE(half.ok());
  EXPECT_THAT(half.error().sentence, HasSubstr("cut short"));
}

TEST(Geoid, SurvivesAnyDamage) {
  std::mt19937 random(13);
  for (const std::string& whole : {japanese_isg(), globe_pgm()}) {
    for (int trial = 0; trial < 2000; ++trial) {
      std::string text = whole;
      for (auto flips = 1 + random() % 6; flips > 0; --flips) {
        text[random() % std::min<std::size_t>(text.size(), 900)] = static_cast<char>(random());
      }
      const auto geoid = parse(text);
      if (geoid.ok()) (void)geoid->undulation_m(30.02, 140.03).ok();
    }
  }
}

}  // namespace
}  // namespace plumbline::geodesy
