// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string_view>

#include "edge/base/gnss_fix.h"

namespace plumbline::gnss {

// The fields of one sentence each (NMEA 0183 4.11; EBP is Emlid's own). An empty field is an empty
// optional. The readers take the fields after the address and return empty where they are too few
// or any of them cannot be read: half a sentence is no sentence.
using Fields = std::span<const std::string_view>;
using TimeOfDay = std::chrono::microseconds;

struct Place {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

struct Gga {  // also GNS, whose mode letters become a quality
  std::optional<TimeOfDay> time_of_day;
  FixQuality quality = FixQuality::kNone;
  std::optional<Place> place;
  std::optional<double> altitude_m;
  std::optional<double> separation_m;  // of geoid and ellipsoid, as the receiver has it
  std::optional<int> satellites;
  std::optional<double> correction_age_s;
};

struct Gst {
  std::optional<TimeOfDay> time_of_day;
  std::optional<Eigen::Matrix3d> covariance_enu_m2;
};

struct GroundVelocity {
  double speed_m_s = 0;              // over ground
  std::optional<double> course_deg;  // from true north, clockwise; empty when standing
};

struct Rmc {
  std::optional<TimeOfDay> time_of_day;
  bool valid = false;
  FixQuality quality = FixQuality::kNone;  // from the mode letter, as far as it tells
  std::optional<Place> place;
  std::optional<GroundVelocity> velocity;
  std::optional<std::chrono::sys_days> date;
};

struct Zda {
  std::optional<TimeOfDay> time_of_day;
  std::optional<std::chrono::sys_days> date;
};

// Where the base station says it stands. The height is above the ellipsoid, as Reach sends it.
struct BasePosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  std::optional<double> height_ellipsoidal_m;
};

struct Ebp {
  std::optional<BasePosition> base;
};

struct Vtg {
  std::optional<GroundVelocity> velocity;
};

std::optional<Gga> read_gga(const Fields& fields);
std::optional<Gga> read_gns(const Fields& fields);
std::optional<Gst> read_gst(const Fields& fields);
std::optional<Rmc> read_rmc(const Fields& fields);
std::optional<Zda> read_zda(const Fields& fields);
std::optional<Vtg> read_vtg(const Fields& fields);
std::optional<Ebp> read_ebp(const Fields& fields);

}  // namespace plumbline::gnss
