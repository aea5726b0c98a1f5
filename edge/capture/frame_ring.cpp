// SPDX-License-Identifier: MIT
#include "edge/capture/frame_ring.h"

namespace plumbline::capture {

std::chrono::nanoseconds distance(HostTime a, HostTime b) { return a < b ? b - a : a - b; }

// Frames come in order: once the next one is expected beyond the mirror image of the nearest about
// the wanted instant, no later one can lie nearer. A tenth of a period is left for jitter.
bool may_improve(HostTime wanted, HostTime nearest_middle, HostTime last_middle,
                 std::chrono::nanoseconds period) {
  const HostTime expected = last_middle + period - period / 10;
  if (expected <= wanted) return true;
  return expected - wanted < distance(nearest_middle, wanted);
}

}  // namespace plumbline::capture
