// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "edge/base/gnss_fix.h"
#include "edge/gnss/leap_seconds.h"
#include "edge/gnss/nmea_framer.h"

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
class RtklibParser {
 public:
  using Sink = std::function<void(const GnssFix&)>;

  explicit RtklibParser(Sink sink) : sink_(std::move(sink)) {}

  void feed(std::string_view bytes);
  void finish();  // the input ends here, with or without a line end

  // `sentences` are solution lines read, `malformed` lines that are neither such nor comments.
  const Counters& counters() const { return counters_; }

  bool time_system_named() const { return time_system_.has_value(); }

  // Where the header says that the columns are other ones: a sentence about what was found and
  // what to write instead. No line is read from there on.
  const std::optional<std::string>& refusal() const { return refusal_; }

 private:
  enum class TimeSystem { kGps, kUtc, kJapan };

  void end_line();
  void take_comment(std::string_view line);
  std::optional<GnssFix> read_line(std::string_view line) const;
  UtcTime utc_from(GpsCivilTime written) const;

  Sink sink_;
  Counters counters_;
  std::string line_;
  std::optional<TimeSystem> time_system_;
  std::optional<std::string> refusal_;
};

}  // namespace plumbline::gnss
