// SPDX-License-Identifier: MIT
#include "edge/capture/stillness.h"

#include <cmath>

namespace plumbline::capture {
void StillnessWatch::add(const Motion& motion) {
  paused_.keep(std::abs(motion.climb_m_s()) < options_.paused_below_m_s, motion.time);
  still_.keep(motion.velocity_m_s.norm() < options_.still_below_m_s, motion.time);
}

void StillnessWatch::reset() {
  paused_ = {};
  still_ = {};
}

bool StillnessWatch::is_still(HostTime now) const { return still_.lasted(now, options_.still_for); }

bool StillnessWatch::is_time(HostTime now) const {
  if (!paused_.lasted(now, options_.paused_after)) return false;
  return is_still(now) || paused_.lasted(now, options_.paused_after + options_.wait_at_most);
}

}  // namespace plumbline::capture
