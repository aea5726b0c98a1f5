// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "edge/gnss/event_match.h"
#include "edge/gnss/time_text.h"
#include "firmware/ingest/gnss_log.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

using std::chrono::microseconds;
using std::chrono::seconds;

constexpr microseconds kDay = std::chrono::hours(24);
constexpr microseconds kQuarterHour = std::chrono::minutes(15);
constexpr double kUnstatedClockSigma_s = 0.1;
// A stamp cut to whole seconds: the exposure is anywhere in the second after it.
constexpr microseconds kHalfSecond = std::chrono::milliseconds(500);
constexpr double kWholeSecondSigma_s = 0.2887;

microseconds in_microseconds(double value_s) { return microseconds(std::llround(value_s * 1e6)); }

// The photos' exposures on one clock, and what that clock is.
struct Exposures {
  std::vector<std::optional<UtcTime>> times;
  bool zone_known = false;     // the times are UTC, not the camera's civil time
  bool whole_seconds = false;  // no photo has fractions
};

bool is_large(const std::optional<TimeOffset>& offset) {
  return offset && std::abs(offset->seconds) >= 900;
}

// UTC where every photo's zone is known, else the camera's clock as shown by all of them. A large
// offset carries the zone itself, unless OffsetTimeOriginal states one.
Exposures exposures_of(const std::vector<PhotoMoment>& photos,
                       const std::optional<TimeOffset>& offset) {
  const bool all_known = std::all_of(photos.begin(), photos.end(), [&](const PhotoMoment& photo) {
    const bool stated = photo.time.offset.has_value();
    const bool untimed = !photo.time.camera_clock && !photo.time.gps;
    return untimed || stated || (!is_large(offset) && utc_of(photo.time).has_value());
  });
  Exposures exposures;
  exposures.zone_known = all_known;
  exposures.whole_seconds = true;
  for (const PhotoMoment& photo : photos) {
    const auto time = all_known ? utc_of(photo.time) : photo.time.camera_clock;
    exposures.times.push_back(time);
    if (!time) continue;
    if (photo.time.has_subseconds) exposures.whole_seconds = false;
  }
  return exposures;
}

void shift(Exposures& exposures, microseconds by) {
  for (auto& time : exposures.times) {
    if (time) *time += by;
  }
}

std::pair<UtcTime, UtcTime> range_of(const std::vector<std::optional<UtcTime>>& times) {
  std::pair<UtcTime, UtcTime> range{UtcTime::max(), UtcTime::min()};
  for (const auto& time : times) {
    if (!time) continue;
    range.first = std::min(range.first, *time);
    range.second = std::max(range.second, *time);
  }
  return range;
}

// Zones, as seconds to add to the clock, that put every photo into the log.
std::vector<long> fitting_zones(const Exposures& exposures, const gnss::AntennaTrack& track) {
  std::vector<long> zones;
  const auto [first, last] = range_of(exposures.times);
  for (int quarters = -56; quarters <= 56; ++quarters) {
    const microseconds shift_by = quarters * kQuarterHour;
    const bool inside = first + shift_by >= track.epochs().front().time &&
                        last + shift_by <= track.epochs().back().time;
    if (inside) zones.push_back(quarters * 900L);
  }
  return zones;
}

Error ask_for_zone(const GnssLog& log, const Exposures& exposures,
                   const gnss::AntennaTrack& track) {
  std::string sentence =
      "The photos do not say their time zone (no OffsetTimeOriginal), so their hour is ambiguous: "
      "pass --time-offset S, the seconds to add to the camera's clock to get UTC (-32400 for "
      "Japan's +09:00)";
  const auto zones = log.date_known ? fitting_zones(exposures, track) : std::vector<long>{};
  if (!zones.empty() && zones.size() <= 3) {
    sentence += "; all photos would fall into " + in_quotes(log.name) + " with";
    for (std::size_t i = 0; i < zones.size(); ++i) {
      sentence += (i > 0 ? " or " : " ") + std::to_string(zones[i]);
    }
  }
  return {sentence + "."};
}

Error no_photo_in_log(const GnssLog& log, const Exposures& exposures,
                      const gnss::AntennaTrack& track) {
  const auto [first, last] = range_of(exposures.times);
  return {"No photo falls into " + in_quotes(log.name) + ": the photos are from " +
          gnss::text_of(first) + " to " + gnss::text_of(last) + ", the log's positions from " +
          gnss::text_of(track.epochs().front().time) + " to " +
          gnss::text_of(track.epochs().back().time) +
          "; pass the log of this flight, or set the camera's clock right with --time-offset."};
}

// A log of times of day is moved to the photos' day, or refused where two days are possible.
Status move_to_log_days(const GnssLog& log, const gnss::AntennaTrack& track, Exposures& exposures) {
  const UtcTime begin = track.epochs().front().time;
  const UtcTime end = track.epochs().back().time;
  if (end - begin >= kDay) {
    return Error{in_quotes(log.name) +
                 " gives times of day without a date over more than a day; record RMC or ZDA."};
  }
  const auto [first, last] = range_of(exposures.times);
  const UtcTime middle = first + (last - first) / 2;
  const UtcTime log_middle = begin + (end - begin) / 2;
  const auto days = std::llround(static_cast<double>((log_middle - middle).count()) /
                                 static_cast<double>(kDay.count()));
  shift(exposures, days * kDay);
  return Done{};
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < 5; ++i) list += (i > 0 ? ", " : "") + names[i];
  return names.size() > 5 ? list + " and " + std::to_string(names.size() - 5) + " more" : list;
}

void warn_of_missing(const std::vector<PhotoMoment>& photos, const std::string& why,
                     AntennaPositions& result) {
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    if (!result.photos[i]) missing.push_back(photos[i].name);
  }
  if (missing.empty()) return;
  result.warnings.push_back(std::to_string(missing.size()) + " of " +
                            std::to_string(photos.size()) + " photos have no GNSS position (" +
                            why + "): " + list_of(missing) + ".");
}

void warn_of_assumed_sigma(const GnssLog& log, AntennaPositions& result) {
  const bool any = std::any_of(result.photos.begin(), result.photos.end(),
                               [](const auto& photo) { return photo && photo->sigma_assumed; });
  if (!any) return;
  result.warnings.push_back(in_quotes(log.name) +
                            " states no sigma for some positions; what is usual for their quality "
                            "was assumed (fixed 1 and 2 cm, float 0.3 and 0.6 m, differential 0.6 "
                            "and 1.2 m, single 3 and 6 m).");
}

AntennaAtPhoto at_photo(const gnss::AntennaState& state, UtcTime utc, double own_time_sigma_s) {
  const Eigen::Vector3d moved_m = state.velocity_enu_m_s * own_time_sigma_s;
  return {state.position,
          state.covariance_enu_m2 + moved_m * moved_m.transpose(),
          state.velocity_enu_m_s,
          state.quality,
          utc,
          state.sigma_assumed};
}

// The sigma of each exposure's own time.
double set_clock(const std::optional<TimeOffset>& offset, Exposures& exposures,
                 AntennaPositions& result) {
  result.common_time_sigma_s = offset ? offset->sigma_s : kUnstatedClockSigma_s;
  if (offset) {
    shift(exposures, in_microseconds(offset->seconds));
  } else {
    result.warnings.push_back(
        "No --time-offset was given: the camera's clock was taken as true to 0.1 s (1 sigma).");
  }
  if (!exposures.whole_seconds) return 0;
  if (!offset) shift(exposures, kHalfSecond);
  result.warnings.push_back(
      std::string("The photos' times are whole seconds (no SubSecTimeOriginal): ") +
      (offset ? "" : "half a second was added, and ") +
      "0.29 s went into the sigma of each position, times the speed.");
  return kWholeSecondSigma_s;
}

Result<AntennaPositions> interpolated(const GnssLog& log, const std::vector<PhotoMoment>& photos,
                                      const std::optional<TimeOffset>& offset,
                                      const gnss::TrackOptions& options) {
  const auto track = gnss::AntennaTrack::from(log.fixes, options);
  Exposures exposures = exposures_of(photos, offset);
  if (track.empty()) return Error{in_quotes(log.name) + " has no position with a time."};
  if (!exposures.zone_known && !offset) return ask_for_zone(log, exposures, track);

  AntennaPositions result;
  const double own_sigma_s = set_clock(offset, exposures, result);
  if (!log.date_known) {
    if (const Status moved = move_to_log_days(log, track, exposures); !moved) return moved.error();
  }
  bool any = false;
  for (const auto& time : exposures.times) {
    const auto state = time ? track.at(*time) : std::nullopt;
    result.photos.emplace_back();
    if (state) result.photos.back() = at_photo(*state, *time, own_sigma_s);
    any = any || state.has_value();
  }
  if (!any) return no_photo_in_log(log, exposures, track);
  warn_of_missing(photos, "no time, outside the log, or in a gap of more than 2 s", result);
  return result;
}

std::vector<UtcTime> mark_times(const GnssLog& log) {
  std::vector<UtcTime> times;
  for (const GnssFix& fix : log.fixes) times.push_back(*fix.time);
  return times;
}

gnss::MatchOptions match_options(const Exposures& exposures,
                                 const std::optional<TimeOffset>& offset) {
  gnss::MatchOptions options;
  if (exposures.whole_seconds) options.tolerance += seconds(1);
  if (offset) {
    options.known_offset = {in_microseconds(offset->seconds),
                            options.tolerance + seconds(1) + in_microseconds(3 * offset->sigma_s)};
  }
  return options;
}

std::optional<AntennaAtPhoto> at_mark(const GnssFix& fix) {
  if (!gnss::is_position(fix)) return std::nullopt;
  const Eigen::Matrix3d usual = gnss::usual_sigma_enu_m(fix.quality).cwiseAbs2().asDiagonal();
  return AntennaAtPhoto{{*fix.latitude_deg, *fix.longitude_deg, *fix.height_ellipsoidal_m},
                        fix.covariance_enu_m2.value_or(usual),
                        std::nullopt,
                        fix.quality,
                        *fix.time,
                        !fix.covariance_enu_m2.has_value()};
}

std::string match_warning(const GnssLog& log, const gnss::EventMatch& match) {
  const double offset_s = std::chrono::duration<double>(match.offset).count();
  std::string sentence = in_quotes(log.name) + " was matched by the intervals of its time marks; ";
  sentence += "GNSS time minus the camera's clock is " +
              std::to_string(std::round(offset_s * 100) / 100).substr(0, 12) + " s";
  if (match.bounced > 0) {
    sentence += ", and " + std::to_string(match.bounced) + " double marks were left out";
  }
  return sentence + ".";
}

// Photo numbers with a time, in order of time (a folder may sort otherwise).
std::vector<std::size_t> in_order_of_time(const Exposures& exposures) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < exposures.times.size(); ++i) {
    if (exposures.times[i]) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return *exposures.times[a] < *exposures.times[b];
  });
  return order;
}

Result<AntennaPositions> at_time_marks(const GnssLog& log, const std::vector<PhotoMoment>& photos,
                                       const std::optional<TimeOffset>& offset) {
  const Exposures exposures = exposures_of(photos, offset);
  const std::vector<std::size_t> order = in_order_of_time(exposures);
  std::vector<UtcTime> times;
  for (const std::size_t i : order) times.push_back(*exposures.times[i]);
  std::vector<UtcTime> marks = mark_times(log);
  if (!std::is_sorted(marks.begin(), marks.end())) {
    return Error{in_quotes(log.name) +
                 " holds time marks that run backwards; pass those of one "
                 "flight, in order."};
  }
  const auto match = gnss::match_events(times, marks, match_options(exposures, offset));
  if (!match) return Error{in_quotes(log.name) + ": " + match.error().sentence + "."};
  AntennaPositions result;
  result.photos.resize(photos.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto event = match->event_of_photo[i];
    if (event) result.photos[order[i]] = at_mark(log.fixes[*event]);
  }
  result.warnings.push_back(match_warning(log, *match));
  warn_of_missing(photos, "no time, no mark, or a mark without a position", result);
  return result;
}

}  // namespace

Result<AntennaPositions> antenna_at_photos(const GnssLog& log,
                                           const std::vector<PhotoMoment>& photos,
                                           const std::optional<TimeOffset>& time_offset,
                                           const gnss::TrackOptions& track) {
  const bool timed = std::any_of(photos.begin(), photos.end(), [](const PhotoMoment& photo) {
    return photo.time.camera_clock || photo.time.gps;
  });
  if (!timed) {
    return Error{"None of the photos says when it was taken (no DateTimeOriginal), so " +
                 in_quotes(log.name) + " cannot be matched to them."};
  }
  auto result = log.time_marks ? at_time_marks(log, photos, time_offset)
                               : interpolated(log, photos, time_offset, track);
  if (!result) return result;
  result->base = log.base;
  warn_of_assumed_sigma(log, *result);
  result->warnings.insert(result->warnings.begin(), log.warnings.begin(), log.warnings.end());
  return result;
}

}  // namespace plumbline::ingest
