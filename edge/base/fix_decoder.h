// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "edge/base/gnss_fix.h"

namespace plumbline {

// What passed through a decoder. Each sentence is counted once: as good, as bad or as malformed.
struct DecoderCounters {
  std::uint64_t bytes = 0;
  std::uint64_t sentences = 0;     // whole and readable, whether of use to us or not
  std::uint64_t bad_checksum = 0;  // ended by '*' and two characters that are not its checksum
  std::uint64_t malformed = 0;     // cut, without checksum, too long, or fields that say nothing
  std::uint64_t epochs = 0;        // position epochs handed out, with or without a position
};

// A part of a stream: offsets into all bytes that were fed, the first one's 0; `end` is one past
// the last. With the arrival times of the bytes it tells when an epoch came.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

// A receiver's bytes in, its fixes out. Knows no port, clock or thread. The decoders themselves are
// those of edge/gnss; a driver is handed one.
class FixDecoder {
 public:
  // An epoch, and the bytes from its first sentence to its last.
  using Sink = std::function<void(const GnssFix&, ByteRange)>;

  virtual ~FixDecoder() = default;

  virtual void feed(std::string_view bytes) = 0;
  virtual void flush() = 0;  // the burst is over: hands out the epoch begun
  virtual void cut() = 0;    // the stream breaks off here: nothing begun goes on after it
  virtual DecoderCounters counters() const = 0;
};

using MakeFixDecoder = std::function<std::unique_ptr<FixDecoder>(FixDecoder::Sink)>;

}  // namespace plumbline
