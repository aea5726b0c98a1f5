// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "edge/base/time.h"

namespace plumbline::timing {

using std::chrono::nanoseconds;

// An instant with its two kinds of error, each one standard deviation.
template <typename Time>
struct Instant {
  Time time;
  nanoseconds sigma_fit{};      // of this instant alone, as far as the fit goes
  nanoseconds sigma_latency{};  // common to the whole flight: the receiver's least latency
};

// How far a receiver's sentences lag behind the instant they are valid for, at the least: what
// arrivals alone cannot tell.
struct Latency {
  nanoseconds value = std::chrono::milliseconds(80);
  nanoseconds sigma = std::chrono::milliseconds(30);
};

// The host clock against GNSS time about now: a line with its covariance. An error of either clock
// beyond `rate` is a random walk of the rate, so sigma grows with the distance from `host`.
struct GnssClock {
  HostTime host;             // the same instant
  GpsTime gps;               // on both clocks
  double rate = 0;           // host seconds per GNSS second, minus 1
  double variance_s2 = 0;    // of the instant, and with the rate
  double covariance_s = 0;   //
  double rate_variance = 0;  //
  double rate_walk_per_sqrt_s = 0;
  nanoseconds latency{};        // that was taken off; 0: from pulses
  nanoseconds sigma_latency{};  // of that, common to the flight
  bool from_pulses = false;

  Instant<GpsTime> gps_of(HostTime time) const;
  Instant<HostTime> host_of(GpsTime time) const;

 private:
  nanoseconds sigma_after(double seconds) const;
};

}  // namespace plumbline::timing
