// SPDX-License-Identifier: MIT
#include "edge/timing/gnss_clock.h"

#include <cmath>

namespace plumbline::timing {
namespace {

// Of a duration in nanoseconds: exact to one nanosecond for days, where the whole is not.
nanoseconds scaled(nanoseconds duration, double factor) {
  return nanoseconds(std::llround(static_cast<double>(duration.count()) * factor));
}

}  // namespace

Instant<GpsTime> GnssClock::gps_of(HostTime time) const {
  const nanoseconds after = time - host;
  const nanoseconds gps_after = after - scaled(after, rate / (1 + rate));
  return {gps + gps_after, sigma_after(in_seconds(gps_after)), sigma_latency};
}

Instant<HostTime> GnssClock::host_of(GpsTime time) const {
  const nanoseconds after = time - gps;
  return {host + after + scaled(after, rate), sigma_after(in_seconds(after)), sigma_latency};
}

nanoseconds GnssClock::sigma_after(double seconds) const {
  // The integral of a random walk over a time T has variance q^2 T^3 / 3.
  const double walked =
      rate_walk_per_sqrt_s * rate_walk_per_sqrt_s * std::abs(seconds) * seconds * seconds / 3;
  const double variance =
      variance_s2 + 2 * covariance_s * seconds + rate_variance * seconds * seconds + walked;
  return nanoseconds(std::llround(1e9 * std::sqrt(std::max(0.0, variance))));
}

}  // namespace plumbline::timing
