// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "edge/base/gnss_fix.h"
#include "edge/gnss/nmea_parser.h"
#include "edge/gnss/rtklib_parser.h"

namespace plumbline::gnss {

enum class LogKind { kUnknown, kNmea, kRtklib };

// Reads either kind of log without being told which: whichever parser first hands out an epoch
// decides, and the other falls silent.
class LogParser {
 public:
  using Sink = std::function<void(const GnssFix&)>;

  explicit LogParser(Sink sink);
  LogParser(const LogParser&) = delete;  // its parsers call back into it
  LogParser& operator=(const LogParser&) = delete;

  void feed(std::string_view bytes);
  void flush();   // the burst is over: hands out the epoch begun
  void finish();  // the input ends here, with or without a line end

  // Told before the first byte: the input may begin amid a line.
  void begin_amid_a_line() { rtklib_.begin_amid_a_line(); }
  // As finish(), but the input broke off: a line begun is none.
  void cut();

  // Of the epoch being handed out.
  ByteRange epoch_bytes() const;

  LogKind kind() const { return kind_; }
  const DecoderCounters& counters() const;
  const std::optional<BasePosition>& base() const { return nmea_.base(); }
  bool gps_time_assumed() const;

  // After finish(): why no epoch came out, as the end of a sentence about the log.
  std::string reason_for_nothing() const;

 private:
  void hand_on(LogKind from, const GnssFix& fix);

  Sink sink_;
  LogKind kind_ = LogKind::kUnknown;
  NmeaParser nmea_;
  RtklibParser rtklib_;
};

}  // namespace plumbline::gnss
