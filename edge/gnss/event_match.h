// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "edge/base/gnss_fix.h"
#include "edge/base/result.h"

namespace plumbline::gnss {

struct MatchOptions {
  // Largest difference between photo intervals and event intervals, anywhere in the flight: the
  // jitter of a camera's own time stamp, plus a whole second where it writes no fractions.
  std::chrono::microseconds tolerance = std::chrono::milliseconds(300);
  // Events closer than this are one exposure whose contact bounced.
  std::chrono::microseconds bounce = std::chrono::milliseconds(50);
  // Where the clocks are known to each other: event minus photo must be this, within the bound.
  struct Offset {
    std::chrono::microseconds value{};
    std::chrono::microseconds bound{};
  };
  std::optional<Offset> known_offset;
};

struct EventMatch {
  std::vector<std::optional<std::size_t>> event_of_photo;  // index into the events given
  std::chrono::microseconds offset{};                      // event minus photo, middle of the range
  std::size_t bounced = 0;                                 // events left out as doubles
};

// Pairs photos with a receiver's time marks by the pattern of their intervals. `photos` are times
// of the camera's own clock, `events` of the receiver; both in increasing order, equal times of
// `photos` allowed. Of the shorter list every member must find its own partner, with one offset
// common to all to within the tolerance. Fails, with a sentence, where no such pairing exists,
// where there are several, or where fewer than three pairs would have to prove themselves and the
// counts differ.
Result<EventMatch> match_events(const std::vector<UtcTime>& photos,
                                const std::vector<UtcTime>& events, const MatchOptions& options);

}  // namespace plumbline::gnss
