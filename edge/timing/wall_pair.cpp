// SPDX-License-Identifier: MIT
#include "edge/timing/wall_pair.h"

#include <cmath>

namespace plumbline::timing {

using std::chrono::nanoseconds;

std::optional<StampOnHost> host_of_wall(WallTime stamp, const WallReading& before,
                                        const WallReading& after, const WallOptions& options) {
  if (after.host <= before.host || stamp < before.wall || stamp > after.wall) return std::nullopt;
  const nanoseconds host_span = after.host - before.host;
  const nanoseconds wall_span = after.wall - before.wall;
  const nanoseconds half_spreads = (before.spread + after.spread) / 2;
  const auto slewed = static_cast<double>(host_span.count()) * options.slew_limit;
  const nanoseconds allowed = half_spreads + options.least_step + nanoseconds(std::llround(slewed));
  const nanoseconds gained = wall_span - host_span;
  if (gained > allowed || gained < -allowed || wall_span <= nanoseconds(0)) return std::nullopt;
  const double share =
      static_cast<double>((stamp - before.wall).count()) / static_cast<double>(wall_span.count());
  const auto correction = nanoseconds(std::llround(share * static_cast<double>(gained.count())));
  // Each pair is off by anything up to half its spread; the rate within is even but for the slew,
  // which may begin anywhere: at worst a quarter of what was gained.
  const double pair =
      static_cast<double>(std::max(before.spread, after.spread).count()) / std::sqrt(12.0);
  const double bend = 0.25 * std::abs(static_cast<double>(gained.count()));
  return StampOnHost{before.host + (stamp - before.wall) - correction,
                     nanoseconds(std::llround(std::hypot(pair, bend)))};
}

}  // namespace plumbline::timing
