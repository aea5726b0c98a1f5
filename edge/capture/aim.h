// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "edge/base/time.h"
#include "edge/capture/decisions.h"
#include "edge/capture/height_steps.h"
#include "edge/capture/navigator.h"

namespace plumbline::capture {

// The next photo: what for, and when the exposure is to be.
struct Aim {
  Target target;
  HostTime instant;
  bool late = false;
  bool still = false;
};

// What the next photo depends on besides motion and heights.
struct AimState {
  std::optional<double> ground_height_m;        // ellipsoidal; without it there are no heights
  std::optional<Eigen::Vector2d> last_place_m;  // east and north of the last photo
  std::optional<HostTime> last_photo;
  HostTime flying_since;
  int aside_taken = 0;
  bool time_to_stop_waiting = false;  // the pilot paused, and this is the moment
  bool at_rest = false;               // as of the newest fix
};

// How far ahead the next photo is looked for.
inline constexpr nanoseconds kLookAhead = std::chrono::milliseconds(1200);

// The first instant from `from` on, up to kLookAhead later, that asks for a photo. `steps` must
// have looked at the height of `from`. Pure.
std::optional<Aim> next_aim(const CapturePlan& plan, const HeightSteps& steps,
                            const Navigator& navigator, const AimState& state,
                            const StillnessOptions& stillness, HostTime from);

}  // namespace plumbline::capture
