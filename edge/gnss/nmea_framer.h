// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "edge/base/fix_decoder.h"

namespace plumbline::gnss {

// Cuts NMEA 0183 sentences out of any stream of bytes: '$', at least two capitals, printable
// characters, '*', the exclusive or of all between '$' and '*' in two hexadecimal digits, and then
// the end of the line. Anything else passes by without harm; noise that does not even begin like
// a sentence is not counted.
class NmeaFramer {
 public:
  // Gets the text between '$' and '*' of a sentence whose checksum holds; false = its fields are
  // not what the sentence's name promises.
  using Sink = std::function<bool(std::string_view body)>;

  explicit NmeaFramer(Sink sink) : sink_(std::move(sink)) {}

  void feed(std::string_view bytes);
  void finish();  // the input ends here, with or without a line end

  // From '$' to the checksum, of the sentence handed out last.
  ByteRange sentence_bytes() const { return sentence_bytes_; }

  DecoderCounters& counters() { return counters_; }
  const DecoderCounters& counters() const { return counters_; }

 private:
  std::size_t take(std::string_view bytes);
  void end_sentence(std::string_view sentence);
  void end_good(std::string_view body);
  void abandon(std::string_view sentence);
  void leave();

  Sink sink_;
  DecoderCounters counters_;
  bool inside_ = false;
  std::uint64_t begin_ = 0;  // where the '$' was
  std::string kept_;         // after '$', of the calls before
  ByteRange sentence_bytes_;
};

}  // namespace plumbline::gnss
