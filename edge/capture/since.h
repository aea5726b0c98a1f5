// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/base/time.h"
#include "edge/capture/capture_plan.h"

namespace plumbline::capture {

// Since when something has held without a break.
class Since {
 public:
  void keep(bool holds, HostTime now) {
    if (!holds) since_.reset();
    if (holds && !since_) since_ = now;
  }
  bool holds() const { return since_.has_value(); }
  bool lasted(HostTime now, nanoseconds time) const { return since_ && now - *since_ >= time; }

 private:
  std::optional<HostTime> since_;
};

}  // namespace plumbline::capture
