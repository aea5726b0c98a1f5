// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "edge/base/pilot_messages.h"
#include "edge/base/pilot_protocol.h"
#include "edge/base/result.h"
#include "edge/base/time.h"

namespace plumbline {

enum class PilotState {
  kAbsent,       // no such port or address, or it went away; looked for again and again
  kSilent,       // open, and nothing comes
  kGarbled,      // bytes come, messages do not: wrong speed, another protocol, or noise
  kNoAutopilot,  // messages come, but no heartbeat of an autopilot
  kAutopilot     // an autopilot is heard
};

// Sent when the state changes.
struct PilotReport {
  HostTime time;
  PilotState state;
  std::string sentence;  // for a person: what, where, what to do
};

using PilotEvent = std::variant<PilotHeartbeat, PilotAttitude, PilotPosition, PilotReport>;

struct PilotLinkCounters {
  PilotCounters heard;
  std::uint64_t heartbeats_sent = 0;
  std::uint64_t texts_sent = 0;
  std::uint64_t texts_dropped = 0;  // too many waited, or too long
  std::uint64_t reconnections = 0;
};

// SEAM: the autopilot, and through it the pilot. start() and stop() are called from one thread, the
// others from any. The sink is called from one thread at a time, a thread of the driver's own (in a
// simulation: that which waits on the clock), in order of arrival, never after stop() has returned;
// it must not block and must not call back into the link.
//
// From start() to stop() the link says once a second that this computer is there (its heartbeat):
// without it an autopilot does not speak to a network address, and shows no texts.
//
// What is promised on failure: a port that is missing, taken away, silent or at the wrong speed is
// not an error of start() but a PilotReport, sent within 5 s; the driver goes on trying and reports
// again when an autopilot is heard. Bytes of before and after a cut never join into one message. A
// bit flipped on the way costs at most the message it is in. Nothing here says that a text was
// seen: it is one-way, and a lost one is not sent again.
class PilotLink {
 public:
  using Sink = std::function<void(PilotEvent)>;

  virtual ~PilotLink() = default;  // stops

  // Fails, with a sentence, where waiting cannot help: no right to open the port, not a port, held
  // by another program, an address that is none; or when started already.
  virtual Status start(Sink sink) = 0;
  virtual void stop() = 0;

  // Has a text shown to the pilot: 50 characters at most, a longer one is cut after a word. Returns
  // at once: the text waits for its turn. Where more than 32 wait, the oldest is dropped, and one
  // that has waited for 10 s is too: late advice is wrong advice. Both are counted, and so is a
  // text said to a link that is not started.
  virtual void say(PilotSeverity severity, std::string_view text) = 0;

  virtual std::string name() const = 0;  // "/dev/ttyAMA1 at 57600 baud"
  virtual PilotLinkCounters counters() const = 0;
};

}  // namespace plumbline
