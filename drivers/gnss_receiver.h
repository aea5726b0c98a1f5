// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>

#include "edge/base/gnss_fix.h"
#include "edge/base/result.h"
#include "edge/base/time.h"

namespace plumbline {

// Bytes as they were read, for the recording: nothing left out, nothing twice, in order.
struct ReceivedBytes {
  HostTime arrival;  // when the read that brought them returned
  std::string bytes;
};

// One position epoch. A fix arrives 50 to 150 ms after the instant it is valid for; the line adds
// 10 bits per byte at the baud rate.
struct ReceivedFix {
  GnssFix fix;
  HostTime first_byte;  // arrival of the read that held the '$' of the epoch's first sentence
  HostTime last_byte;   // arrival of the read that ended its last one
};

enum class ReceiverState {
  kAbsent,    // no such port or host, or it went away; looked for again and again
  kSilent,    // open, and nothing comes
  kGarbled,   // bytes come, sentences do not: wrong speed, another protocol, or noise
  kNoFix,     // sentences come, a position does not
  kPosition,  // positions come
  kJumped     // positions come, and the last one is not where the one before could have gone
};

// Sent when the state changes, and with kJumped for each jump.
struct ReceiverReport {
  HostTime time;
  ReceiverState state;
  std::string sentence;  // for a person: what, where, what to do
};

using ReceiverEvent = std::variant<ReceivedBytes, ReceivedFix, ReceiverReport>;

struct ReceiverCounters {
  std::uint64_t bytes = 0;
  std::uint64_t sentences = 0;  // whole, of use or not
  std::uint64_t bad_checksum = 0;
  std::uint64_t malformed = 0;
  std::uint64_t epochs = 0;  // with or without position
  std::uint64_t reconnections = 0;
};

// SEAM: a receiver that says where its antenna is. start() and stop() are called from one thread.
// The sink is called from one thread at a time, a thread of the driver's own (in a simulation: that
// which waits on the clock), in order of arrival, never after stop() has returned; it must not
// block and must not call back into the receiver.
//
// What is promised on failure: a port that is missing, taken away, silent or at the wrong speed is
// not an error of start() but a ReceiverReport, sent within 2 s; the driver goes on trying and
// reports again when positions flow, within 2 s of the port's return. Bytes of before and after a
// cut never join into one sentence. A byte flipped on the way costs at most the sentence it is in.
class GnssReceiver {
 public:
  using Sink = std::function<void(ReceiverEvent)>;

  virtual ~GnssReceiver() = default;  // stops

  // Fails, with a sentence, where waiting cannot help: no right to open the port, not a port, held
  // by another program, an address that is none; or when started already.
  virtual Status start(Sink sink) = 0;
  virtual void stop() = 0;

  virtual std::string name() const = 0;           // "/dev/ttyACM0 at 115200 baud"
  virtual ReceiverCounters counters() const = 0;  // from any thread
};

}  // namespace plumbline
