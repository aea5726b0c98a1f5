// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

#include "edge/base/result.h"
#include "edge/base/time.h"

namespace plumbline {

// A pulse that was put out. Its first edge lies between the two readings of the clock around the
// call that made it.
struct Pulse {
  HostTime before;
  HostTime after;
  std::chrono::nanoseconds width;  // as kept: never shorter than asked for
};

// An edge of the input line (hot-shoe feedback, PPS), stamped by the kernel in its interrupt.
struct LineEdge {
  HostTime time;
  bool rising = true;          // in terms of the line's polarity: rising means "became active"
  std::uint64_t sequence = 0;  // counts on without a gap as long as none was lost
};

// Edges came faster than they were taken: so many are missing before the next one.
struct EdgesLost {
  HostTime time;
  std::uint64_t count = 0;
};

// The line went away (a chip on a bus unplugged). No edges follow.
struct LineFault {
  HostTime time;
  std::string sentence;
};

using LineEvent = std::variant<LineEdge, EdgesLost, LineFault>;

// SEAM: a wire to the camera's shutter, and one back. Either may be missing: then its member fails
// with a sentence, and the other works. pulse(), listen() and stop() are called from one thread;
// the sink from one thread of the driver's own, in order of time, never after stop() has returned,
// and never of what happened before listen(). The output is inactive from construction until the
// first pulse and after the destructor, also when the program dies between the two edges of a pulse
// (as far as the chip keeps no state).
class TriggerLine {
 public:
  using Sink = std::function<void(LineEvent)>;

  virtual ~TriggerLine() = default;  // stops; leaves the output inactive

  // One pulse of the width and polarity of the line's options; blocks for its width.
  virtual Result<Pulse> pulse() = 0;

  virtual Status listen(Sink sink) = 0;
  virtual void stop() = 0;
};

}  // namespace plumbline
