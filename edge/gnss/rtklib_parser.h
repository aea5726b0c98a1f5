// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "edge/base/fix_decoder.h"
#include "edge/base/gnss_fix.h"
#include "edge/gnss/leap_seconds.h"

namespace plumbline::gnss {

// RTKLIB solution text in, fixes out: .pos of post-processing (also the events file, one line per
// time mark) and the LLH stream or log of Emlid Reach. Source: RTKLIB 2.4.2 manual, appendix B.1.
//
//   yyyy/mm/dd hh:mm:ss.sss | week tow   latitude longitude height Q ns
//   sdn sde sdu sdne sdeu sdun age ratio [more]       from sdn on a line may end early
//
// separated by blanks, tabs, commas or semicolons. Lines beginning with '%' are comments; one of
// them names the time system (GPST, UTC or JST), without it GPST is taken. Heights are above the
// ellipsoid. sdne, sdeu, sdun are signed square roots: the covariance is sd * |sd|. Six zeros mean
// that no sigma is given.
//
// Q 1 fix, 2 float, 3 SBAS, 4 DGPS, 5 single, 6 PPP becomes kFixed, kFloat, kDifferential,
// kDifferential, kSingle, kFloat (PPP: ambiguities as real numbers).
//
// Binary messages between the lines pass by: a line begins behind them, with its date. A line has
// no checksum: a byte that became another within a number is not noticed.
class RtklibParser {
 public:
  using Sink = std::function<void(const GnssFix&)>;

  explicit RtklibParser(Sink sink) : sink_(std::move(sink)) {}

  void feed(std::string_view bytes);
  void finish();  // the input ends here, with or without a line end

  // The bytes begin or go on amid a line: what is there of it is no line.
  void begin_amid_a_line();

  // Of the line being handed out.
  ByteRange epoch_bytes() const { return epoch_bytes_; }

  // `sentences` are solution lines read, `malformed` lines that are neither such nor comments.
  const DecoderCounters& counters() const { return counters_; }

  bool time_system_named() const { return time_system_.has_value(); }

  // Where the header says that the columns are other ones: a sentence about what was found and
  // what to write instead. No line is read from there on.
  const std::optional<std::string>& refusal() const { return refusal_; }

 private:
  enum class TimeSystem { kGps, kUtc, kJapan };

  void keep(std::string_view part);
  void end_line(std::string_view line);
  void take_solution(std::string_view line);
  void take_comment(std::string_view line);
  std::optional<GnssFix> read_line(std::string_view line) const;
  UtcTime utc_from(GpsCivilTime written) const;

  Sink sink_;
  DecoderCounters counters_;
  std::string kept_;          // of a line begun in the calls before
  bool cut_off_ = false;      // it lacks its beginning
  bool amid_a_line_ = false;  // the next line end is that of a line not seen whole
  ByteRange epoch_bytes_;
  std::optional<TimeSystem> time_system_;
  std::optional<std::string> refusal_;
};

}  // namespace plumbline::gnss
