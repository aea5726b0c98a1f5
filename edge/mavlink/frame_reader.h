// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "edge/base/pilot_protocol.h"
#include "edge/mavlink/frame.h"

namespace plumbline::mavlink {

// Cuts MAVLink 1 and 2 frames out of any stream of bytes. Whatever is not a frame costs only
// itself: after a false start the search goes on one byte later, so that a whole frame is never
// swallowed by garbage before it. A frame of an unknown kind cannot be verified, since its
// CRC_EXTRA is not known; it is skipped by its length only if some CRC_EXTRA makes its checksum
// right, which one piece of garbage in 256 passes.
class FrameReader {
 public:
  // Gets frames of known kinds whose checksum holds, the payload filled up with the zeros that
  // MAVLink 2 left out.
  using Sink = std::function<void(const Frame&)>;

  explicit FrameReader(Sink sink) : sink_(std::move(sink)) {}

  void feed(std::string_view bytes);

  // No more bytes come for now: looks into what began like a frame and was not finished.
  void flush();

  // What was begun does not go on.
  void cut();

  PilotCounters& counters() { return counters_; }
  const PilotCounters& counters() const { return counters_; }

 private:
  std::size_t take_all(std::string_view bytes);
  std::size_t take(std::string_view bytes);
  std::size_t take_whole(std::string_view bytes);
  std::size_t drop_garbage(std::size_t count);
  void hand_on(std::string_view bytes, const Definition& definition);

  Sink sink_;
  PilotCounters counters_;
  std::string pending_;  // begins with a start mark, or is empty
};

}  // namespace plumbline::mavlink
