// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/base/time.h"
#include "edge/geodesy/local_frame.h"
#include "edge/timing/antenna_predictor.h"
#include "edge/timing/gnss_clock.h"

namespace plumbline::timing {

// When the antenna gets somewhere, as foreseen.
struct Crossing {
  GpsTime time;
  // Of the instant: the position's uncertainty there, divided by the speed.
  nanoseconds sigma{};
  // Towards it and through: up, or away from the point; negative: down, or nearer.
  double speed_m_s = 0;
};

// When the antenna first crosses a height, up or down, at `from` or later but not after
// `from + within`. Empty when it will not, as far as it can be foreseen: `antenna` looks no further
// than its own `longest_ahead`. The sigma holds the error that all heights of a flight share; where
// the height is counted from a take-off point seen by the same receiver, it is on the safe side.
std::optional<Crossing> crossing_of_height(const AntennaPredictor& antenna, double height_m,
                                           GpsTime from, nanoseconds within);

// The same for a horizontal distance from `point`, outwards or inwards. Also empty where `point` is
// no place.
std::optional<Crossing> crossing_of_distance(const AntennaPredictor& antenna,
                                             const geodesy::Geodetic& point, double distance_m,
                                             GpsTime from, nanoseconds within);

// On the host's clock: the clock's own sigma is in `sigma_fit`, too, and that of the least latency
// is apart, one error common to the flight.
Instant<HostTime> on_host(const Crossing& crossing, const GnssClock& clock);

}  // namespace plumbline::timing
