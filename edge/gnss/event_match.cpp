// SPDX-License-Identifier: MIT
#include "edge/gnss/event_match.h"

#include <algorithm>
#include <string>
#include <utility>

namespace plumbline::gnss {
namespace {

using std::chrono::microseconds;
using Times = std::vector<UtcTime>;

// For each of the shorter list, its partner in the longer one.
struct Pairing {
  std::vector<std::size_t> partner;
  microseconds offset{};  // longer minus shorter
  bool doubtful = false;  // one of the shorter list could as well have another partner
};

std::vector<std::size_t> without_bounces(const Times& events, microseconds bounce) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (kept.empty() || events[i] - events[kept.back()] > bounce) kept.push_back(i);
  }
  return kept;
}

std::size_t nearest(const Times& times, UtcTime to) {
  const auto after = std::lower_bound(times.begin(), times.end(), to);
  if (after == times.begin()) return 0;
  if (after == times.end()) return times.size() - 1;
  const bool before_is_nearer = to - *(after - 1) <= *after - to;
  return static_cast<std::size_t>(after - times.begin()) - (before_is_nearer ? 1 : 0);
}

bool has_rival(const Times& shorter, const Times& longer, const Pairing& pairing,
               microseconds tolerance) {
  for (const UtcTime time : shorter) {
    const UtcTime expected = time + pairing.offset;
    const auto first = std::lower_bound(longer.begin(), longer.end(), expected - tolerance);
    const auto last = std::upper_bound(first, longer.end(), expected + tolerance);
    if (last - first > 1) return true;
  }
  return false;
}

// The pairing in which the first of `shorter` meets number `start` of `longer`, if all agree.
std::optional<Pairing> pair_from(std::size_t start, const Times& shorter, const Times& longer,
                                 microseconds tolerance) {
  Pairing pairing;
  const microseconds guess = longer[start] - shorter[0];
  microseconds least = guess;
  microseconds most = guess;
  for (const UtcTime time : shorter) {
    const std::size_t partner = nearest(longer, time + guess);
    if (!pairing.partner.empty() && partner <= pairing.partner.back()) return std::nullopt;
    pairing.partner.push_back(partner);
    least = std::min(least, longer[partner] - time);
    most = std::max(most, longer[partner] - time);
    if (most - least > tolerance) return std::nullopt;
  }
  pairing.offset = least + (most - least) / 2;
  pairing.doubtful = has_rival(shorter, longer, pairing, tolerance);
  return pairing;
}

// Equal counts leave only one pairing: number by number.
std::optional<Pairing> pair_in_order(const Times& photos, const Times& events,
                                     microseconds tolerance) {
  Pairing pairing;
  microseconds least = events[0] - photos[0];
  microseconds most = least;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    pairing.partner.push_back(i);
    least = std::min(least, events[i] - photos[i]);
    most = std::max(most, events[i] - photos[i]);
  }
  if (most - least > tolerance) return std::nullopt;
  pairing.offset = least + (most - least) / 2;
  return pairing;
}

std::vector<Pairing> all_pairings(const Times& shorter, const Times& longer,
                                  microseconds tolerance) {
  if (shorter.size() == longer.size()) {
    const auto only = pair_in_order(shorter, longer, tolerance);
    return only ? std::vector<Pairing>{*only} : std::vector<Pairing>{};
  }
  std::vector<Pairing> found;
  for (std::size_t start = 0; start + shorter.size() <= longer.size(); ++start) {
    auto pairing = pair_from(start, shorter, longer, tolerance);
    if (!pairing) continue;
    const bool known = !found.empty() && found.back().partner == pairing->partner;
    if (!known) found.push_back(std::move(*pairing));
  }
  return found;
}

std::string in_seconds(microseconds duration) {
  const auto hundredths = std::chrono::round<std::chrono::duration<long, std::centi>>(duration);
  const std::string digits = std::to_string(hundredths.count() % 100);
  return std::to_string(hundredths.count() / 100) + "." + (digits.size() < 2 ? "0" : "") + digits +
         " s";
}

std::string counts_of(std::size_t photos, std::size_t events) {
  return std::to_string(photos) + " photos and " + std::to_string(events) + " time marks";
}

Error not_one(std::size_t fits, const std::string& counts, const MatchOptions& options) {
  const std::string within = " within " + in_seconds(options.tolerance);
  if (fits == 0) {
    return {"the intervals between the " + counts + " do not agree" + within +
            (options.known_offset ? " at the time offset given" : "") +
            "; pass the photos of this flight only, all of them"};
  }
  return {"the " + counts + " fit each other in several ways" + within +
          "; pass exactly the photos that belong to the marks, or --time-offset so that the "
          "clocks decide"};
}

EventMatch match_of(const Pairing& pairing, bool photos_are_shorter, std::size_t photo_count,
                    const std::vector<std::size_t>& kept) {
  EventMatch match;
  match.event_of_photo.resize(photo_count);
  match.offset = photos_are_shorter ? pairing.offset : -pairing.offset;
  for (std::size_t i = 0; i < pairing.partner.size(); ++i) {
    const std::size_t photo = photos_are_shorter ? i : pairing.partner[i];
    match.event_of_photo[photo] = kept[photos_are_shorter ? pairing.partner[i] : i];
  }
  return match;
}

}  // namespace

Result<EventMatch> match_events(const Times& photos, const Times& events,
                                const MatchOptions& options) {
  const std::vector<std::size_t> kept = without_bounces(events, options.bounce);
  Times marks;
  for (const std::size_t i : kept) marks.push_back(events[i]);
  const std::string counts = counts_of(photos.size(), marks.size());
  if (photos.empty() || marks.empty()) return Error{"there is nothing to match in " + counts};

  const bool photos_are_shorter = photos.size() <= marks.size();
  const Times& shorter = photos_are_shorter ? photos : marks;
  const Times& longer = photos_are_shorter ? marks : photos;
  const bool proves_itself = shorter.size() >= 3 || shorter.size() == longer.size();
  if (!proves_itself && !options.known_offset) {
    return Error{"too few to match by their intervals: " + counts + "; pass --time-offset"};
  }
  std::vector<Pairing> fits = all_pairings(shorter, longer, options.tolerance);
  std::erase_if(fits, [&](const Pairing& pairing) {
    if (!options.known_offset) return false;
    const microseconds offset = photos_are_shorter ? pairing.offset : -pairing.offset;
    const microseconds off = offset - options.known_offset->value;
    return off > options.known_offset->bound || -off > options.known_offset->bound;
  });
  const bool doubtful = fits.size() == 1 && fits[0].doubtful;
  if (fits.size() != 1 || doubtful) return not_one(fits.size(), counts, options);
  EventMatch match = match_of(fits[0], photos_are_shorter, photos.size(), kept);
  match.bounced = events.size() - marks.size();
  return match;
}

}  // namespace plumbline::gnss
