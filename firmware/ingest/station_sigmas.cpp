// SPDX-License-Identifier: MIT
#include "firmware/ingest/station_sigmas.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace plumbline::ingest {
namespace {

using Eigen::Vector3d;

// One standard deviation east, north, up, of one position by itself.
//
// Fixed, not stated: what makers promise for RTK near the base (10 mm + 1 ppm, 15 mm + 1 ppm) with
// room for the offset of shutter and antenna.
const Vector3d kFixedM(0.02, 0.02, 0.03);
// Float: decimetres (P. Teunissen and O. Montenbruck, Springer Handbook of GNSS, 2017, ch. 26).
const Vector3d kFloatM(0.3, 0.3, 0.6);
// Single fixes of a small receiver in the open: 3 to 5 m in plan, twice that in height (M. Wing et
// al. 2005, J. Forestry 103, 169-173; P. Zandbergen and S. Barbeau 2011, J. Navigation 64,
// 381-399).
const Vector3d kSingleM(3, 3, 6);
// Of a camera that does not say: a receiver of its own, without a clear view, at the worse end.
const Vector3d kUnsaidM(4, 4, 8);

// Without fixed ambiguities most of the error is common to the minutes of a flight (orbits, clocks,
// ionosphere, the ambiguities themselves), some drifts in tens of seconds (multipath, and the
// receiver's own smoothing, by which its height lags behind in a climb), the rest is noise. In
// parts of the sigma of one position:
constexpr double kCommonPart = 1.0;
constexpr double kDriftPart = 1.0 / 2;
// A camera's own receiver smooths so much that in a climb it may report half of it: its error
// moves as far as it is large.
constexpr double kUnsaidDriftPart = 1.0;
constexpr double kWhitePart = 1.0 / 3;
constexpr double kDriftS = 30;

bool is_fixed(const PhotoPosition* position) { return position->fix == PhotoFix::kFixed; }

Vector3d sigma_m(const PhotoPosition* position) {
  if (position->sigma_enu_m) return *position->sigma_enu_m;
  if (is_fixed(position)) return kFixedM;
  if (position->fix == PhotoFix::kNotSaid) return kUnsaidM;
  return position->fix == PhotoFix::kFloat ? kFloatM : kSingleM;
}

Vector3d rms(const std::vector<Vector3d>& sigmas) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& sigma : sigmas) sum += sigma.cwiseAbs2();
  return (sum / static_cast<double>(sigmas.size())).cwiseSqrt();
}

double in_plan(const Vector3d& sigma) { return std::sqrt(0.5 * sigma.head<2>().squaredNorm()); }

// No position is fixed: all share one offset and one drift.
StationSigmas without_fixed(const std::vector<const PhotoPosition*>& positions, bool times_known) {
  StationSigmas result;
  std::transform(positions.begin(), positions.end(), std::back_inserter(result.white_m), sigma_m);
  const Vector3d usual_m = rms(result.white_m);
  const bool unsaid = std::ranges::any_of(
      positions, [](const auto* position) { return position->fix == PhotoFix::kNotSaid; });
  const double moving = unsaid ? kUnsaidDriftPart : kDriftPart;
  const double drift = times_known ? moving : 0;
  const double white = times_known ? kWhitePart : std::hypot(kWhitePart, moving);
  for (Vector3d& sigma : result.white_m) sigma *= white;
  result.common = {kCommonPart * in_plan(usual_m), kCommonPart * usual_m.z(),
                   times_known ? kDriftS : 0, drift * in_plan(usual_m), drift * usual_m.z()};
  const bool floating = std::ranges::all_of(
      positions, [](const auto* position) { return position->fix == PhotoFix::kFloat; });
  char figures[120];
  std::snprintf(figures, sizeof figures, "%.2g m in plan and %.2g m in height", in_plan(usual_m),
                usual_m.z());
  result.warnings.push_back(
      std::string("The photos' positions are ") +
      (floating ? "float RTK solutions" : "single fixes, not RTK ones") +
      ": an error common to all of " + figures + " was taken, with drift of " +
      (unsaid ? "as much" : "half") +
      " and noise of a third of it. Absolute position, and scale where no length or control is "
      "given, rest on them alone.");
  return result;
}

// Fixed positions carry the flight; what is not fixed counts with the whole of its error.
StationSigmas with_fixed(const std::vector<const PhotoPosition*>& positions) {
  StationSigmas result;
  const double whole = std::hypot(std::hypot(kCommonPart, kDriftPart), kWhitePart);
  for (const PhotoPosition* position : positions) {
    result.white_m.push_back(sigma_m(position) * (is_fixed(position) ? 1 : whole));
  }
  const auto unstated = std::ranges::count_if(
      positions, [](const auto* p) { return is_fixed(p) && !p->sigma_enu_m; });
  if (unstated > 0) {
    result.warnings.push_back(std::to_string(unstated) +
                              " photos with a fixed RTK position state no sigma for it; 2 cm in "
                              "plan and 3 cm in height were assumed.");
  }
  const auto poor = std::ranges::count_if(positions, [](const auto* p) { return !is_fixed(p); });
  if (poor > 0) {
    result.warnings.push_back(std::to_string(poor) + " of " + std::to_string(positions.size()) +
                              " positions are not fixed RTK ones and were given less weight.");
  }
  return result;
}

}  // namespace

StationSigmas station_sigmas(const std::vector<const PhotoPosition*>& positions, bool times_known) {
  return std::ranges::any_of(positions, is_fixed) ? with_fixed(positions)
                                                  : without_fixed(positions, times_known);
}

}  // namespace plumbline::ingest
