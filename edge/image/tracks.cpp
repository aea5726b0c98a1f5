// SPDX-License-Identifier: MIT
#include "edge/image/tracks.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "edge/base/parallel.h"
#include "edge/image/corners.h"
#include "edge/image/correlation_search.h"
#include "edge/image/epipolar.h"
#include "edge/image/prediction.h"

namespace plumbline::image {
namespace {

constexpr int kMargin_px = 16;
// Of a cell's side: a corner this near an observation is taken to be measured already.
constexpr double kTakenShare = 0.6;
constexpr double kSameCorner_px = 4.0;
// A point of two photos holds little against mistakes: it is taken where others are this much
// rarer.
constexpr int kPairsLater = 2;

struct Partner {
  int photo = 0;
  double scale = 1;  // partner pixels per reference pixel
  Predictor predictor;
};

std::vector<Correspondence> reversed(const std::vector<Correspondence>& matches) {
  std::vector<Correspondence> result;
  for (const Correspondence& match : matches) result.push_back({match.second_px, match.first_px});
  return result;
}

double scale_at_centre(const Eigen::Matrix3d& homography, const PhotoLevels& photo) {
  return scale_of(local_map(homography, photo.size_px() / 2).jacobian);
}

std::vector<Partner> partners_of(int reference, const std::vector<PhotoLevels>& photos,
                                 const std::vector<ScreenedPair>& pairs) {
  std::vector<Partner> partners;
  const PhotoLevels& own = photos[static_cast<std::size_t>(reference)];
  for (const ScreenedPair& screened : pairs) {
    const PhotoPair& pair = screened.pair;
    if (pair.first != reference && pair.second != reference) continue;
    const bool forward = pair.first == reference;
    const Eigen::Matrix3d homography =
        forward ? pair.second_from_first : Eigen::Matrix3d(pair.second_from_first.inverse());
    partners.push_back(
        {forward ? pair.second : pair.first, scale_at_centre(homography, own),
         Predictor(homography, forward ? screened.matches : reversed(screened.matches),
                   own.size_px().x())});
  }
  return partners;
}

std::optional<PatchMatch> match_point(const PhotoLevels& reference, const PhotoLevels& target,
                                      const Prediction& prediction) {
  const auto found =
      search_by_correlation(reference, target, prediction.map, prediction.radius_px, {});
  if (!found) return std::nullopt;
  return match_patch(reference.full(), target.full(), *found, {});
}

// What one corner became: its matches, one slot per partner.
using Star = std::vector<std::optional<PatchMatch>>;

void drop_suspects(std::vector<Star>& stars, const std::vector<Partner>& partners,
                   std::uint64_t seed) {
  for (std::size_t k = 0; k < partners.size(); ++k) {
    std::vector<Correspondence> matches;
    std::vector<std::size_t> owner;
    for (std::size_t s = 0; s < stars.size(); ++s) {
      if (!stars[s][k]) continue;
      matches.push_back({stars[s][k]->map.reference_px, stars[s][k]->map.target_px});
      owner.push_back(s);
    }
    const auto suspect = off_epipolar_line(matches, std::max(1.0, partners[k].scale), seed + k);
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (suspect[i]) stars[owner[i]][k].reset();
  }
}

std::optional<Track> track_of(const Star& star, int reference,
                              const std::vector<Partner>& partners) {
  Track track(1);
  Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < star.size(); ++k) {
    if (!star[k]) continue;
    track.push_back({partners[k].photo, 0, star[k]->map.target_px, star[k]->target_covariance_px2});
    own += star[k]->reference_covariance_px2;
    track.front().pixel = star[k]->map.reference_px;
  }
  if (track.size() < 2) return std::nullopt;
  track.front().photo = reference;
  track.front().covariance_px2 = own / static_cast<double>(track.size() - 1);
  return track;
}

class Measured {
 public:
  explicit Measured(std::size_t photos) : places_px_(photos) {}

  void add(const Track& track) {
    for (const TieObservation& one : track)
      places_px_[static_cast<std::size_t>(one.photo)].push_back(one.pixel);
  }
  bool near(int photo, const Eigen::Vector2d& pixel, double radius_px) const {
    const auto& places = places_px_[static_cast<std::size_t>(photo)];
    return std::any_of(places.begin(), places.end(), [&](const Eigen::Vector2d& place) {
      return (place - pixel).squaredNorm() < radius_px * radius_px;
    });
  }

 private:
  std::vector<std::vector<Eigen::Vector2d>> places_px_;
};

// The tracks with most photos first. Two references may each have found the same corner: the second
// of such tracks is left out.
std::vector<Track> without_repeats(const std::vector<Track>& tracks, int photo_count) {
  std::vector<std::size_t> order(tracks.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tracks[a].size() > tracks[b].size();
  });
  Measured measured(static_cast<std::size_t>(photo_count));
  std::vector<Track> kept;
  for (const std::size_t index : order) {
    const Track& track = tracks[index];
    const bool repeats = std::any_of(track.begin(), track.end(), [&](const TieObservation& one) {
      return measured.near(one.photo, one.pixel, kSameCorner_px);
    });
    if (repeats) continue;
    measured.add(track);
    kept.push_back(track);
  }
  return kept;
}

// One reference photo and those that see the same ground.
struct Reference {
  int photo = 0;
  std::vector<Partner> partners;
  std::vector<Eigen::Vector2d> corners;
};

std::vector<Star> match_corners(const std::vector<PhotoLevels>& photos, const Reference& reference,
                                int threads, MatchMemory& memory) {
  const std::vector<Partner>& partners = reference.partners;
  const std::vector<Eigen::Vector2d>& corners = reference.corners;
  const int own = reference.photo;
  const PhotoLevels& own_levels = photos[static_cast<std::size_t>(own)];
  std::vector<Star> stars(corners.size(), Star(partners.size()));
  std::vector<std::vector<std::size_t>> untried(corners.size());  // partners of each corner
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (std::size_t k = 0; k < partners.size(); ++k) {
      const auto* known = memory.find(own, partners[k].photo, corners[c]);
      if (known != nullptr) stars[c][k] = *known;
      if (known == nullptr) untried[c].push_back(k);
    }
  }
  parallel_for(static_cast<int>(corners.size()), threads, [&](int corner) {
    const auto c = static_cast<std::size_t>(corner);
    for (const std::size_t k : untried[c]) {
      const Prediction prediction = partners[k].predictor.predict(corners[c]);
      stars[c][k] =
          match_point(own_levels, photos[static_cast<std::size_t>(partners[k].photo)], prediction);
    }
  });
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (const std::size_t k : untried[c])
      memory.keep(own, partners[k].photo, corners[c], stars[c][k]);
  }
  return stars;
}

std::vector<Track> measure_reference(const std::vector<PhotoLevels>& photos,
                                     const Reference& reference, const TieOptions& options,
                                     MatchMemory& memory) {
  std::vector<Star> stars = match_corners(photos, reference, options.threads, memory);
  drop_suspects(stars, reference.partners,
                options.seed * 31U + static_cast<std::uint64_t>(reference.photo) * 977U);
  std::vector<Track> tracks;
  for (const Star& star : stars) {
    if (auto track = track_of(star, reference.photo, reference.partners))
      tracks.push_back(std::move(*track));
  }
  return tracks;
}

}  // namespace

const MatchMemory::Match* MatchMemory::find(int reference, int partner,
                                            const Eigen::Vector2d& corner_px) const {
  const auto both = matches_.find({reference, partner});
  if (both == matches_.end()) return nullptr;
  const auto match = both->second.find({corner_px.x(), corner_px.y()});
  return match == both->second.end() ? nullptr : &match->second;
}

void MatchMemory::keep(int reference, int partner, const Eigen::Vector2d& corner_px,
                       const Match& match) {
  matches_[{reference, partner}].insert_or_assign({corner_px.x(), corner_px.y()}, match);
}

std::vector<int> finest_first(const std::vector<PhotoLevels>& photos,
                              const std::vector<ScreenedPair>& pairs) {
  std::vector<double> log_scale(photos.size(), 0.0);
  std::vector<bool> known(photos.size(), false);
  for (std::size_t start = 0; start < photos.size(); ++start) {
    if (!known[start]) known[start] = true;
    for (bool grown = true; grown;) {
      grown = false;
      for (const ScreenedPair& screened : pairs) {
        const auto i = static_cast<std::size_t>(screened.pair.first);
        const auto j = static_cast<std::size_t>(screened.pair.second);
        if (known[i] == known[j]) continue;
        const double step = std::log(scale_at_centre(screened.pair.second_from_first, photos[i]));
        if (known[i]) log_scale[j] = log_scale[i] + step;
        if (known[j]) log_scale[i] = log_scale[j] - step;
        known[i] = known[j] = grown = true;
      }
    }
  }
  std::vector<int> order(photos.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return log_scale[static_cast<std::size_t>(a)] > log_scale[static_cast<std::size_t>(b)];
  });
  return order;
}

std::vector<Track> measure_tracks(const std::vector<PhotoLevels>& photos,
                                  const std::vector<ScreenedPair>& pairs, const TieOptions& options,
                                  const std::function<void(int done, int total)>& progress,
                                  MatchMemory& memory) {
  std::vector<Track> tracks;
  Measured measured(photos.size());
  int done = 0;
  for (const int reference : finest_first(photos, pairs)) {
    const PhotoLevels& photo = photos[static_cast<std::size_t>(reference)];
    auto partners = partners_of(reference, photos, pairs);
    progress(done++, static_cast<int>(photos.size()));
    if (partners.empty()) continue;
    const int cells = std::max(options.ties_wanted * 4 / 5, 50);
    const double side_px = std::sqrt(photo.size_px().prod() / cells);
    auto corners = best_corners(photo, CellGrid(photo.size_px(), cells), kMargin_px);
    std::erase_if(corners, [&](const Eigen::Vector2d& corner) {
      return measured.near(reference, corner, kTakenShare * side_px);
    });
    const Reference own{reference, std::move(partners), std::move(corners)};
    for (Track& track : measure_reference(photos, own, options, memory)) {
      measured.add(track);
      tracks.push_back(std::move(track));
    }
  }
  progress(done, static_cast<int>(photos.size()));
  return tracks;
}

std::vector<Track> choose_tracks(const std::vector<Track>& tracks, int wanted, int photo_count,
                                 const Eigen::Vector2d& photo_size_px) {
  const CellGrid grid(photo_size_px, std::max(wanted / 20, 1));
  std::vector<int> taken(static_cast<std::size_t>(grid.count() * photo_count), 0);
  const auto cell = [&](const TieObservation& one) {
    return static_cast<std::size_t>(one.photo * grid.count() + grid.cell_of(one.pixel));
  };
  const std::vector<Track> candidates = without_repeats(tracks, photo_count);
  std::vector<bool> used(candidates.size(), false);
  std::vector<Track> kept;
  const auto goal = std::min(candidates.size(), static_cast<std::size_t>(std::max(wanted, 0)));
  for (int most = 1; kept.size() < goal; ++most) {
    for (std::size_t i = 0; i < candidates.size() && kept.size() < goal; ++i) {
      const Track& track = candidates[i];
      const int limit = track.size() > 2 ? most : most - kPairsLater;
      const bool needed = std::any_of(track.begin(), track.end(), [&](const TieObservation& one) {
        return taken[cell(one)] < limit;
      });
      if (used[i] || !needed) continue;
      used[i] = true;
      for (const TieObservation& one : track) ++taken[cell(one)];
      kept.push_back(track);
    }
  }
  return kept;
}

}  // namespace plumbline::image
