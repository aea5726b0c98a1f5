// SPDX-License-Identifier: MIT
#include "drivers/jump_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/base/units.h"

namespace plumbline {
namespace {

// Earth-centred coordinates on WGS84 (semi-major axis 6378137 m, flattening 1/298.257223563).
Eigen::Vector3d earth_centred_m(const GnssFix& fix, double height_m) {
  constexpr double kRadius_m = 6378137.0;
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double latitude = *fix.latitude_deg * kRadPerDeg;
  const double longitude = *fix.longitude_deg * kRadPerDeg;
  const double sine = std::sin(latitude);
  const double normal_m = kRadius_m / std::sqrt(1 - kEccentricity2 * sine * sine);
  const double from_axis_m = (normal_m + height_m) * std::cos(latitude);
  return {from_axis_m * std::cos(longitude), from_axis_m * std::sin(longitude),
          (normal_m * (1 - kEccentricity2) + height_m) * sine};
}

double distance_m(const GnssFix& a, const GnssFix& b) {
  const bool heights = a.height_ellipsoidal_m && b.height_ellipsoidal_m;
  return (earth_centred_m(a, heights ? *a.height_ellipsoidal_m : 0) -
          earth_centred_m(b, heights ? *b.height_ellipsoidal_m : 0))
      .norm();
}

double usual_error_m(FixQuality quality) {
  switch (quality) {
    case FixQuality::kFixed:
      return 1;
    case FixQuality::kFloat:
      return 5;
    case FixQuality::kDifferential:
      return 10;
    default:
      return 30;
  }
}

double possible_error_m(const GnssFix& fix) {
  const double stated_m =
      fix.covariance_enu_m2 ? 6 * std::sqrt(fix.covariance_enu_m2->trace()) : 0.0;
  return std::max(usual_error_m(fix.quality), stated_m);
}

double seconds_of(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

bool is_measured_position(const GnssFix& fix) {
  const bool measured = fix.quality >= FixQuality::kSingle && fix.quality <= FixQuality::kFloat;
  return measured && fix.latitude_deg && fix.longitude_deg;
}

std::optional<Jump> JumpCheck::take(const GnssFix& fix, HostTime arrival) {
  const std::optional<Seen> before = std::exchange(before_, Seen{fix, arrival});
  if (!before) return std::nullopt;
  const GnssFix& last = before->fix;
  double seconds = seconds_of(arrival - before->arrival);
  if (fix.time && last.time && *fix.time > *last.time) seconds = seconds_of(*fix.time - *last.time);
  const Jump step{distance_m(last, fix), std::max(seconds, 0.0)};
  const double reach_m =
      fastest_m_s_ * step.seconds + possible_error_m(last) + possible_error_m(fix);
  if (step.distance_m <= reach_m) return std::nullopt;
  return step;
}

}  // namespace plumbline
