// SPDX-License-Identifier: MIT
#include "edge/image/screen.h"

#include <algorithm>
#include <mutex>
#include <optional>

#include "edge/base/parallel.h"

namespace plumbline::image {
namespace {

constexpr int kFeaturesPerPhoto = 2000;
constexpr int kFewestInliers = 15;
// Of the photo's width: the homography's consensus must survive lens distortion and low relief.
constexpr double kPlaneTolerance = 0.006;
constexpr std::size_t kScreenNeighbours = 8;
constexpr int kFewestAgreeing = 3;

// Residuals of matches against the plane, and which agree with their neighbours: relief and
// distortion vary from place to place, but a wrong match agrees with nobody.
std::vector<Correspondence> agreeing(const std::vector<Correspondence>& matches,
                                     const Eigen::Matrix3d& homography, double tolerance_px) {
  std::vector<Eigen::Vector2d> residual;
  for (const Correspondence& match : matches)
    residual.push_back(match.second_px - transform(homography, match.first_px));
  std::vector<Correspondence> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      if (k != i) others.emplace_back((matches[k].first_px - matches[i].first_px).norm(), k);
    }
    const std::size_t count = std::min(kScreenNeighbours, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
                      others.end());
    int friends = 0;
    for (std::size_t n = 0; n < count; ++n)
      friends += (residual[others[n].second] - residual[i]).norm() < tolerance_px ? 1 : 0;
    if (friends >= kFewestAgreeing) kept.push_back(matches[i]);
  }
  return kept;
}

std::optional<ScreenedPair> screen_pair(const Features& first, const Features& second, int i, int j,
                                        double width_px, std::uint64_t seed) {
  std::vector<Correspondence> matches;
  for (const auto& [a, b] : match_features(first, second)) {
    matches.push_back({first.place_px[static_cast<std::size_t>(a)],
                       second.place_px[static_cast<std::size_t>(b)]});
  }
  const double tolerance_px = kPlaneTolerance * width_px;
  const std::uint64_t own_seed =
      seed * 1000003U + static_cast<std::uint64_t>(i) * 7919U + static_cast<std::uint64_t>(j);
  const auto consensus = find_homography(matches, tolerance_px, own_seed);
  if (!consensus || static_cast<int>(consensus->inliers.size()) < kFewestInliers)
    return std::nullopt;
  ScreenedPair screened;
  screened.matches = agreeing(matches, consensus->second_from_first, tolerance_px);
  screened.pair = {i, j, consensus->second_from_first, static_cast<int>(consensus->inliers.size())};
  if (static_cast<int>(screened.matches.size()) < kFewestInliers) return std::nullopt;
  return screened;
}

}  // namespace

void Screening::add(const std::vector<PhotoLevels>& photos, const TieOptions& options,
                    const std::function<void(int done, int total)>& progress) {
  const int before = static_cast<int>(features_.size());
  const int count = static_cast<int>(photos.size());
  features_.resize(photos.size());
  std::mutex mutex;
  int done = before;
  parallel_for(count - before, options.threads, [&](int k) {
    const auto slot = static_cast<std::size_t>(before + k);
    features_[slot] = detect_features(photos[slot], kFeaturesPerPhoto);
    const std::lock_guard lock(mutex);
    progress(++done, count);
  });
  std::vector<std::pair<int, int>> both;
  for (int j = before; j < count; ++j)
    for (int i = 0; i < j; ++i) both.emplace_back(i, j);
  std::vector<std::optional<ScreenedPair>> found(both.size());
  parallel_for(static_cast<int>(both.size()), options.threads, [&](int k) {
    const auto [i, j] = both[static_cast<std::size_t>(k)];
    const Features& first = features_[static_cast<std::size_t>(i)];
    const Features& second = features_[static_cast<std::size_t>(j)];
    found[static_cast<std::size_t>(k)] = screen_pair(
        first, second, i, j, photos[static_cast<std::size_t>(i)].size_px().x(), options.seed);
  });
  for (auto& pair : found) {
    if (pair) pairs_.push_back(std::move(*pair));
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const ScreenedPair& a, const ScreenedPair& b) {
    return std::pair(a.pair.first, a.pair.second) < std::pair(b.pair.first, b.pair.second);
  });
}

}  // namespace plumbline::image
