// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "edge/base/time.h"

namespace plumbline::sim {

// What happened on a receiver's line at one instant, simulated or recorded.
struct LinePiece {
  enum class Kind { kPluggedIn, kBytes, kPulled };

  HostTime time;
  Kind kind = Kind::kBytes;
  std::string bytes;  // of kBytes
};

// One after the other in order of time; empty where there is none (yet).
using LineSource = std::function<std::optional<LinePiece>()>;

}  // namespace plumbline::sim
