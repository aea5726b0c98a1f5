// SPDX-License-Identifier: MIT
#pragma once

#include "edge/base/time.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/navigator.h"
#include "edge/capture/since.h"

namespace plumbline::capture {

// Whether the pilot has paused the climb, and whether the drone has come to rest. Pure.
class StillnessWatch {
 public:
  explicit StillnessWatch(const StillnessOptions& options) : options_(options) {}

  void add(const Motion& motion);
  void reset();

  // Paused, and now is the time for the photo: at rest, or waited for long enough.
  bool is_time(HostTime now) const;
  bool is_still(HostTime now) const;

 private:
  StillnessOptions options_;
  Since paused_;  // the climb
  Since still_;
};

}  // namespace plumbline::capture
