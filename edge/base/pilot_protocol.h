// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "edge/base/pilot_messages.h"

namespace plumbline {

// What passed through a protocol's reader. Every byte is of a frame, whole or skipped, or garbage,
// or waits for the rest of its frame.
struct PilotCounters {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;         // whole, and of a kind that is read
  std::uint64_t unknown = 0;        // whole, of a kind that is not read: skipped
  std::uint64_t bad_checksum = 0;   // began like a frame, and was none or a damaged one
  std::uint64_t malformed = 0;      // of `frames`: length or content is not that of its kind
  std::uint64_t incompatible = 0;   // of `frames`: with a flag that nobody here understands
  std::uint64_t signed_frames = 0;  // of `frames`: the signature was not looked at
  std::uint64_t of_others = 0;      // of `frames`: not from the autopilot that is listened to
  std::uint64_t garbage_bytes = 0;  // between frames
};

// Both directions of a conversation with an autopilot, as bytes. Knows no port, clock or thread.
// The protocols themselves are those of edge/mavlink; a driver is handed one.
class PilotProtocol {
 public:
  using Sink = std::function<void(const PilotMessage&)>;

  virtual ~PilotProtocol() = default;

  virtual void feed(HostTime arrival, std::string_view bytes) = 0;
  virtual void flush() = 0;  // a pause: what was begun is not being finished
  virtual void cut() = 0;    // the stream breaks off here: nothing begun goes on after it

  // The bytes of one frame to send.
  virtual std::string heartbeat() = 0;
  virtual std::string text(PilotSeverity severity, std::string_view text) = 0;

  virtual PilotCounters counters() const = 0;
};

using MakePilotProtocol = std::function<std::unique_ptr<PilotProtocol>(PilotProtocol::Sink)>;

}  // namespace plumbline
