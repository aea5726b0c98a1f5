// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "edge/base/exposure_timing.h"
#include "edge/base/gnss_fix.h"
#include "edge/base/time.h"

namespace plumbline::capture {

// What the deciding thread hears. Every decision follows from these and the options alone, so that
// a recording of them gives the same decisions again.

// The first input of every run.
struct Started {
  WallTime wall;  // only to give a day to times of day
};

// The program was stopped, and begins anew: in place of the take-off where the flight was under
// way; else only the ground is known from before, for the drone may have taken off meanwhile.
struct Resumed {
  bool flying = true;
  double ground_height_m = 0;  // ellipsoidal
  std::optional<UtcTime> last_fix;
  int photos = 0;                   // the highest number given out
  std::vector<std::uint8_t> taken;  // one per entry of the plan's heights, in its order: 1 if taken
  std::optional<HostTime> last_seen;  // what was heard last, where the computer ran on since
};

struct FixHeard {
  GnssFix fix;
  HostTime first_byte;
  bool jumped = false;  // the receiver was said to have jumped here
};
struct PulsePerSecond {
  HostTime edge;
};

struct FrameSeen {
  std::uint64_t sequence = 0;
  int interior_number = 0;
  ExposureTiming timing;
  int rows = 0;
};
struct CameraSeen {
  bool streaming = false;
};
// Hot-shoe feedback: the shutter is open.
struct ShutterOpened {
  HostTime edge;
};

struct PilotSeen {
  std::optional<bool> armed;  // empty: it is heard no more
};

// The time that was asked for has come.
struct Tick {};

// The autopilot's own height, by its barometer and receiver.
struct PilotHeightSeen {
  double above_arming_m = 0;
  double climb_m_s = 0;
};

// A photo that was decided, and then could not be kept.
struct PhotoLost {
  int number = 0;
};

using Happening = std::variant<Started, Resumed, FixHeard, PulsePerSecond, FrameSeen, CameraSeen,
                               ShutterOpened, PilotSeen, Tick, PilotHeightSeen, PhotoLost>;

struct Input {
  HostTime now;  // when the deciding thread took it up; never goes back
  Happening what;
};

}  // namespace plumbline::capture
