// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace plumbline::gnss {

// What passed through a parser. Each sentence is counted once: as good, as bad or as malformed.
struct Counters {
  std::uint64_t bytes = 0;
  std::uint64_t sentences = 0;     // whole and readable, whether of use to us or not
  std::uint64_t bad_checksum = 0;  // ended by '*' and two characters that are not its checksum
  std::uint64_t malformed = 0;     // cut, without checksum, too long, or fields that say nothing
  std::uint64_t epochs = 0;        // position epochs handed out, with or without a position
};

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

  Counters& counters() { return counters_; }
  const Counters& counters() const { return counters_; }

 private:
  void take(char c);
  void end_sentence();
  void abandon();

  Sink sink_;
  Counters counters_;
  bool inside_ = false;
  std::string sentence_;  // after '$'
};

}  // namespace plumbline::gnss
