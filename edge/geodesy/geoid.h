// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "edge/base/result.h"

namespace plumbline::geodesy {

// A geoid model: height of the geoid above the ellipsoid on a grid of latitude and longitude,
// handed in as the bytes of its file. Interpolated bilinearly, as Japan's own Geoid programs do
// (GeographicLib's default is cubic: for the 5' EGM96 grid the two differ by up to 1 m in trenches,
// typically centimetres). ellipsoidal height = orthometric height + undulation.
class Geoid {
 public:
  // Recognised by their first bytes: .pgm as GeographicLib has them (16-bit, "# Offset",
  // "# Scale", whole globe), and ISG 1.0 and 2.0 text (Japan's Geoid 2024 and many national
  // models). `name` is the file's name for sentences.
  static Result<Geoid> parse(std::span<const std::uint8_t> bytes, const std::string& name);

  // Metres. Fails outside the grid and where the grid holds no value.
  Result<double> undulation_m(double latitude_deg, double longitude_deg) const;

  const std::string& name() const { return name_; }

 private:
  friend class GeoidReader;
  Geoid() = default;
  double node_m(int row, int column) const;

  std::string name_;
  double north_deg_ = 0;  // latitude of row 0; rows run southwards
  double west_deg_ = 0;   // longitude of column 0
  double step_lat_deg_ = 0;
  double step_lon_deg_ = 0;
  int rows_ = 0;
  int columns_ = 0;
  bool around_the_globe_ = false;  // the last column is followed by the first
  std::vector<float> heights_m_;   // row by row; NaN where there is no value
};

}  // namespace plumbline::geodesy
