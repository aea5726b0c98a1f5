// SPDX-License-Identifier: MIT
#include "edge/timing/crossing.h"

#include <algorithm>
#include <cmath>

namespace plumbline::timing {
namespace {

// Motion that is forgotten within a second does not turn back and forth in a tenth.
constexpr nanoseconds kStep = std::chrono::milliseconds(100);
constexpr int kNewtonSteps = 4;

// How far beyond the place to be crossed, and how fast.
struct Progress {
  double beyond_m = 0;
  double speed_m_s = 0;
  double sigma_m = 0;
};

double sigma_along(const PredictedAntenna& antenna, const Eigen::Vector3d& direction) {
  return std::sqrt(direction.dot(antenna.covariance_enu_m2 * direction));
}

// Newton's method, kept between two instants on either side.
template <typename ProgressAt>
std::optional<Crossing> crossing_between(GpsTime low, GpsTime high, const ProgressAt& progress_at) {
  GpsTime time = low + (high - low) / 2;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const auto here = progress_at(time);
    if (!here || here->speed_m_s == 0) return std::nullopt;
    const double limit_s = std::chrono::duration<double>(high - low).count();
    const double step_s = std::clamp(-here->beyond_m / here->speed_m_s, -limit_s, limit_s);
    time = std::clamp(time + from_seconds(step_s), low, high);
  }
  const auto there = progress_at(time);
  if (!there || there->speed_m_s == 0) return std::nullopt;
  // Beyond an hour the speed is as good as none.
  const double sigma_s = std::min(3600.0, there->sigma_m / std::abs(there->speed_m_s));
  return Crossing{time, from_seconds(sigma_s), there->speed_m_s};
}

template <typename ProgressAt>
std::optional<Crossing> first_crossing(GpsTime from, nanoseconds within,
                                       const ProgressAt& progress_at) {
  const GpsTime last = from + within;
  auto before = progress_at(from);
  for (GpsTime time = from; before && time < last;) {
    const GpsTime next = std::min(time + kStep, last);
    const auto after = progress_at(next);
    if (!after) return std::nullopt;
    if ((before->beyond_m < 0) != (after->beyond_m < 0)) {
      return crossing_between(time, next, progress_at);
    }
    before = after;
    time = next;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Crossing> crossing_of_height(const AntennaPredictor& antenna, double height_m,
                                           GpsTime from, nanoseconds within) {
  const auto progress_at = [&](GpsTime time) -> std::optional<Progress> {
    const auto there = antenna.at(time);
    if (!there) return std::nullopt;
    return Progress{there->position.height_ellipsoidal_m - height_m, there->velocity_enu_m_s.z(),
                    sigma_along(*there, Eigen::Vector3d::UnitZ())};
  };
  return first_crossing(from, within, progress_at);
}

std::optional<Crossing> crossing_of_distance(const AntennaPredictor& antenna,
                                             const geodesy::Geodetic& point, double distance_m,
                                             GpsTime from, nanoseconds within) {
  const auto frame = geodesy::LocalFrame::at(point);
  if (!frame) return std::nullopt;
  const auto progress_at = [&](GpsTime time) -> std::optional<Progress> {
    const auto there = antenna.at(time);
    if (!there) return std::nullopt;
    Eigen::Vector3d outwards = frame->enu_of(there->position);
    outwards.z() = 0;
    const double away_m = outwards.norm();
    // At the point itself every direction leads away from it.
    outwards = away_m > 0 ? Eigen::Vector3d(outwards / away_m) : Eigen::Vector3d::UnitX();
    return Progress{away_m - distance_m, outwards.dot(there->velocity_enu_m_s),
                    sigma_along(*there, outwards)};
  };
  return first_crossing(from, within, progress_at);
}

Instant<HostTime> on_host(const Crossing& crossing, const GnssClock& clock) {
  Instant<HostTime> instant = clock.host_of(crossing.time);
  const auto fit_ns = static_cast<double>(instant.sigma_fit.count());
  const auto own_ns = static_cast<double>(crossing.sigma.count());
  instant.sigma_fit = nanoseconds(std::llround(std::hypot(fit_ns, own_ns)));
  return instant;
}

}  // namespace plumbline::timing
