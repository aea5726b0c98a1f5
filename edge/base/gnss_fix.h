// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>

namespace plumbline {

// Civil time (UTC, leap seconds not counted) to a microsecond.
using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

// The quality field of NMEA GGA; the numbers are those of the sentence. The last three are no
// measurements of satellites and never positions to work with.
enum class FixQuality {
  kNone = 0,
  kSingle = 1,
  kDifferential = 2,
  kPps = 3,
  kFixed = 4,
  kFloat = 5,
  kEstimated = 6,
  kManual = 7,
  kSimulated = 8
};

// One position epoch of a receiver, as it said it. Nothing here is corrected or guessed: what the
// receiver did not say is empty.
struct GnssFix {
  std::optional<UtcTime> time;                           // absolute, when a date is known
  std::optional<std::chrono::microseconds> time_of_day;  // UTC, since midnight
  FixQuality quality = FixQuality::kNone;
  std::optional<double> latitude_deg;
  std::optional<double> longitude_deg;
  std::optional<double> height_ellipsoidal_m;  // GGA: altitude + separation
  std::optional<double> altitude_m;            // above the receiver's own (coarse) geoid
  std::optional<Eigen::Matrix3d> covariance_enu_m2;
  std::optional<int> satellites;
  std::optional<double> correction_age_s;
};

}  // namespace plumbline
