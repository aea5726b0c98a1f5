// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "edge/image/least_squares_matching.h"
#include "edge/image/screen.h"

namespace plumbline::image {

// One corner of a reference photo and where least-squares matching found it in others. Every match
// is with the reference's own patch, so that errors do not add up along a chain of photos.
// observations.front() is the reference's; `point` is not yet set.
using Track = std::vector<TieObservation>;

// What matching has found before, of a series of photos that grows: the same corner is not matched
// with the same photo again.
class MatchMemory {
 public:
  using Match = std::optional<PatchMatch>;  // nothing: it was not found

  // nullptr where it was not tried.
  const Match* find(int reference, int partner, const Eigen::Vector2d& corner_px) const;
  void keep(int reference, int partner, const Eigen::Vector2d& corner_px, const Match& match);

 private:
  using Place = std::pair<double, double>;
  std::map<std::pair<int, int>, std::map<Place, Match>> matches_;  // by reference and partner
};

// Measures well-spread corners of every photo that is in a pair. Photos with the finest view of the
// ground go first, and no photo takes a corner where it has an observation already.
std::vector<Track> measure_tracks(const std::vector<PhotoLevels>& photos,
                                  const std::vector<ScreenedPair>& pairs, const TieOptions& options,
                                  const std::function<void(int done, int total)>& progress,
                                  MatchMemory& memory);

// Photo numbers, the finest view of the ground first, by the scales of the pairs' homographies.
std::vector<int> finest_first(const std::vector<PhotoLevels>& photos,
                              const std::vector<ScreenedPair>& pairs);

// At most `wanted` of the tracks: those seen in more photos first, evenly over every photo, and
// none that lies on a point of one already chosen.
std::vector<Track> choose_tracks(const std::vector<Track>& tracks, int wanted, int photo_count,
                                 const Eigen::Vector2d& photo_size_px);

}  // namespace plumbline::image
