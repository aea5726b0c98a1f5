// SPDX-License-Identifier: MIT
#include "firmware/ingest/gnss_log.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "edge/gnss/log_parser.h"
#include "edge/gnss/log_shape.h"
#include "firmware/ingest/number.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

using gnss::LogKind;

bool named_as_events(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.find("event") != std::string::npos;
}

void warn_of_damage(const DecoderCounters& counters, GnssLog& log) {
  const auto damaged = counters.bad_checksum + counters.malformed;
  if (damaged == 0) return;
  log.warnings.push_back(in_quotes(log.name) + ": " + std::to_string(damaged) + " of " +
                         std::to_string(counters.sentences + damaged) +
                         " lines are damaged and were left out.");
}

void warn_of_assumptions(const gnss::LogParser& parser, GnssLog& log) {
  if (parser.gps_time_assumed()) {
    log.warnings.push_back(in_quotes(log.name) +
                           " does not name its time system; its times were taken as GPS time, "
                           "which is 18 s ahead of UTC.");
  }
  if (!log.date_known) {
    log.warnings.push_back(in_quotes(log.name) +
                           " gives times of day without a date; it was taken to be of the photos' "
                           "day.");
  }
}

Error nothing_usable(const GnssLog& log) {
  const bool any_place = std::any_of(log.fixes.begin(), log.fixes.end(), [](const GnssFix& fix) {
    return fix.latitude_deg.has_value();
  });
  return {in_quotes(log.name) +
          (any_place ? " has no ellipsoidal heights (its positions lack altitude or geoid "
                       "separation); record GGA."
                     : " holds " + std::to_string(log.fixes.size()) +
                           " epochs, but the receiver had no position in any of them.")};
}

}  // namespace

Result<GnssLog> read_gnss_log(const std::filesystem::path& path) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  GnssLog log;
  log.name = path.filename().string();
  gnss::LogParser parser([&log](const GnssFix& fix) { log.fixes.push_back(fix); });
  parser.feed(*text);
  parser.finish();
  if (log.fixes.empty()) {
    return Error{in_quotes(path.string()) + " " + parser.reason_for_nothing() + "."};
  }
  if (std::none_of(log.fixes.begin(), log.fixes.end(), gnss::is_position)) {
    return nothing_usable(log);
  }
  log.date_known = gnss::complete_dates(log.fixes) != gnss::DateState::kUnknown;
  log.time_marks = parser.kind() == LogKind::kRtklib &&
                   (named_as_events(log.name) || gnss::looks_like_time_marks(log.fixes));
  log.base = parser.base();
  warn_of_damage(parser.counters(), log);
  warn_of_assumptions(parser, log);
  return log;
}

Result<TimeOffset> parse_time_offset(std::string_view text) {
  constexpr double kLongest_s = 400.0 * 86400.0;
  const std::size_t comma = text.find(',');
  const auto seconds = parse_number(text.substr(0, comma));
  TimeOffset offset;
  std::optional<double> sigma = offset.sigma_s;
  if (comma != std::string_view::npos) sigma = parse_number(text.substr(comma + 1));
  if (!seconds || !sigma || *sigma < 0 || std::abs(*seconds) > kLongest_s || *sigma > kLongest_s) {
    return Error{
        "--time-offset wants seconds, or seconds and their sigma, as in -32400 or "
        "0.35,0.05; it was given " +
        in_quotes(text) + "."};
  }
  return TimeOffset{*seconds, *sigma};
}

}  // namespace plumbline::ingest
