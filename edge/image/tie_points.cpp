// SPDX-License-Identifier: MIT
#include "edge/image/tie_points.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <numeric>
#include <opencv2/core.hpp>

#include "edge/image/load.h"
#include "edge/image/screen.h"
#include "edge/image/tracks.h"

namespace plumbline::image {
namespace {

// Numbers the points and sorts each one's observations by photo.
void take_tracks(std::vector<Track> tracks, TiePoints& ties) {
  for (Track& track : tracks) {
    std::sort(track.begin(), track.end(),
              [](const TieObservation& a, const TieObservation& b) { return a.photo < b.photo; });
    for (TieObservation& one : track) {
      one.point = ties.point_count;
      ties.observations.push_back(one);
    }
    ++ties.point_count;
  }
}

// Photos that share a point share a component, numbered from 0 in order of their first photo.
std::vector<int> components(const std::vector<TieObservation>& observations, int photo_count) {
  std::vector<int> root(static_cast<std::size_t>(photo_count));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int photo) {
    while (root[static_cast<std::size_t>(photo)] != photo)
      photo = root[static_cast<std::size_t>(photo)];
    return photo;
  };
  std::vector<bool> tied(root.size(), false);
  for (std::size_t i = 1; i < observations.size(); ++i) {
    if (observations[i].point != observations[i - 1].point) continue;
    const int a = find(observations[i - 1].photo);
    const int b = find(observations[i].photo);
    root[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    tied[static_cast<std::size_t>(observations[i].photo)] = true;
    tied[static_cast<std::size_t>(observations[i - 1].photo)] = true;
  }
  std::vector<int> component(root.size(), -1);
  std::vector<int> number(root.size(), -1);
  int next = 0;
  for (int photo = 0; photo < photo_count; ++photo) {
    if (!tied[static_cast<std::size_t>(photo)]) continue;
    int& own = number[static_cast<std::size_t>(find(photo))];
    if (own < 0) own = next++;
    component[static_cast<std::size_t>(photo)] = own;
  }
  return component;
}

}  // namespace

struct TieFinder::Known {
  std::vector<PhotoLevels> photos;
  Screening screening;
  MatchMemory matches;

  TiePoints tie(const TieOptions& options, const Progress& progress) {
    const int count = static_cast<int>(photos.size());
    const auto tell = [&](const char* stage) {
      return [&progress, stage](int done, int total) {
        if (progress) progress(stage, done, total);
      };
    };
    TiePoints ties;
    screening.add(photos, options, tell("compare photos"));
    const auto& pairs = screening.pairs();
    for (const ScreenedPair& screened : pairs) ties.pairs.push_back(screened.pair);
    auto tracks = measure_tracks(photos, pairs, options, tell("measure tie points"), matches);
    Eigen::Vector2d size_px(1, 1);
    for (const PhotoLevels& photo : photos) size_px = size_px.cwiseMax(photo.size_px());
    take_tracks(choose_tracks(tracks, options.ties_wanted, count, size_px), ties);
    ties.component = components(ties.observations, count);
    return ties;
  }
};

TieFinder::TieFinder() : known_(std::make_unique<Known>()) {}
TieFinder::~TieFinder() = default;
TieFinder::TieFinder(TieFinder&&) noexcept = default;
TieFinder& TieFinder::operator=(TieFinder&&) noexcept = default;

Result<TiePoints> TieFinder::find(const GreyImageSource& photos, int photo_count,
                                  const TieOptions& options, const Progress& progress) {
  try {
    // The photos are shared out among threads here; OpenCV's own threads would only get in the way.
    cv::setNumThreads(1);
    const Status loaded =
        load_photos(photos, photo_count, options.threads, progress, known_->photos);
    if (!loaded) return loaded.error();
    return known_->tie(options, progress);
  } catch (const std::exception& error) {
    known_ = std::make_unique<Known>();
    return Error{std::string("Measuring tie points failed inside a library (") + error.what() +
                 "); try with fewer or smaller photos."};
  }
}

Result<TiePoints> find_tie_points(const GreyImageSource& photos, int photo_count,
                                  const TieOptions& options, const Progress& progress) {
  return TieFinder().find(photos, photo_count, options, progress);
}

}  // namespace plumbline::image
