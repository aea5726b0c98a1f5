// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "edge/base/parallel.h"
#include "edge/image/correlation_search.h"
#include "edge/image/least_squares_matching.h"
#include "edge/image/load.h"
#include "edge/image/prediction.h"
#include "edge/image/tie_points.h"

namespace plumbline::image {
namespace {

// A patch grows until it holds enough texture: the middle of a large target is blank.
constexpr std::array<int, 6> kHalfSizes = {8, 11, 15, 20, 27, 36};
constexpr double kWantedSigma_px = 0.03;
constexpr double kGreyNoise = 3.0;
constexpr std::size_t kFewestLocalMatches = 8;

// Picks decide where named points are, so they are held to more than ties are.
MatchOptions strict(int half_size) { return {half_size, 0.85, 3.0, 0.25}; }
SearchOptions alone(int half_size) { return {half_size, 0.7, 0.85}; }

struct PairMatches {
  Eigen::Matrix3d second_from_first = Eigen::Matrix3d::Identity();
  std::vector<Correspondence> matches;
};

// What the ties say of photos `first` and `second` (first picked in, second searched).
std::optional<PairMatches> matches_of(const TiePoints& ties, int first, int second) {
  PairMatches found;
  const Eigen::Vector2d* in_first = nullptr;
  const Eigen::Vector2d* in_second = nullptr;
  int point = -1;
  for (const TieObservation& one : ties.observations) {
    if (one.point != point) in_first = in_second = nullptr;
    point = one.point;
    if (one.photo != first && one.photo != second) continue;
    (one.photo == first ? in_first : in_second) = &one.pixel;
    if (in_first && in_second) found.matches.push_back({*in_first, *in_second});
  }
  if (found.matches.size() < kFewestLocalMatches) return std::nullopt;
  const auto homography = fit_homography(found.matches);
  if (!homography) return std::nullopt;
  found.second_from_first = *homography;
  return found;
}

// Precision to be expected of a match of this patch: the gradient's second moments (Foerstner and
// Guelch 1987) against the noise of the grey values.
double expected_sigma_px(const cv::Mat& photo, const Eigen::Vector2d& centre_px, double spacing_px,
                         int half) {
  const Window window = smoothed_window(photo, centre_px, spacing_px * half + 5, 0.7 * spacing_px);
  Eigen::Matrix2d moments = Eigen::Matrix2d::Identity() * 1e-9;
  for (int row = -half; row <= half; ++row) {
    for (int col = -half; col <= half; ++col) {
      const auto sample = sample_cubic(window, centre_px + spacing_px * Eigen::Vector2d(col, row));
      if (!sample) return INFINITY;
      const Eigen::Vector2d gradient(sample->du * spacing_px, sample->dv * spacing_px);
      moments += gradient * gradient.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(moments, Eigen::EigenvaluesOnly);
  return kGreyNoise / std::sqrt(solver.eigenvalues()(0));
}

int half_size_for(const cv::Mat& photo, const Pick& pick, double spacing_px) {
  for (const int half : kHalfSizes)
    if (expected_sigma_px(photo, pick.pixel, spacing_px, half) < kWantedSigma_px) return half;
  return kHalfSizes.back();
}

std::optional<PatchMatch> find_pick(const PhotoLevels& reference, const PhotoLevels& target,
                                    const Pick& pick, const Predictor& predictor) {
  if (reference.empty() || target.empty()) return std::nullopt;
  const Prediction prediction = predictor.predict(pick.pixel);
  const double spacing_px = std::max(1.0, 1.0 / scale_of(prediction.map.jacobian));
  const int half = half_size_for(reference.full(), pick, spacing_px);
  const auto found =
      search_by_correlation(reference, target, prediction.map, prediction.radius_px, alone(half));
  if (!found) return std::nullopt;
  return match_patch(reference.full(), target.full(), *found, strict(half));
}

// The pick carries its own error; that of the match is all in the new observation.
TieObservation observation_of(const PatchMatch& match, int photo, int point) {
  const Eigen::Matrix2d& jacobian = match.map.jacobian;
  return {photo, point, match.map.target_px,
          match.target_covariance_px2 +
              jacobian * match.reference_covariance_px2 * jacobian.transpose()};
}

struct Job {
  Pick pick;
  int target = 0;
  const Predictor* predictor = nullptr;
};

using Predictors = std::map<std::pair<int, int>, Predictor>;

std::vector<Job> jobs_for(const std::vector<Pick>& picks, int photo_count,
                          const Predictors& predictors) {
  std::set<std::pair<int, int>> by_hand;  // (point, photo)
  for (const Pick& pick : picks) by_hand.emplace(pick.point, pick.photo);
  std::vector<Job> jobs;
  for (const Pick& pick : picks) {
    for (int photo = 0; photo < photo_count; ++photo) {
      const auto found = predictors.find({pick.photo, photo});
      if (found == predictors.end() || by_hand.count({pick.point, photo}) > 0) continue;
      jobs.push_back({pick, photo, &found->second});
    }
  }
  return jobs;
}

Predictors predictors_for(const std::vector<Pick>& picks, const TiePoints& ties,
                          const std::vector<PhotoLevels>& photos) {
  Predictors predictors;
  std::set<int> picked;
  for (const Pick& pick : picks) picked.insert(pick.photo);
  for (const int first : picked) {
    for (int second = 0; second < static_cast<int>(photos.size()); ++second) {
      const auto matches = first == second ? std::nullopt : matches_of(ties, first, second);
      if (!matches) continue;
      const double width_px = photos[static_cast<std::size_t>(second)].size_px().x();
      predictors.emplace(std::pair(first, second),
                         Predictor(matches->second_from_first, matches->matches, width_px));
    }
  }
  return predictors;
}

// One observation per point and photo: of several picks of a point, the match that correlates best.
std::vector<TieObservation> best_of(const std::vector<Job>& jobs,
                                    const std::vector<std::optional<PatchMatch>>& matches) {
  std::map<std::pair<int, int>, std::size_t> best;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!matches[i]) continue;
    const auto [place, fresh] = best.try_emplace({jobs[i].pick.point, jobs[i].target}, i);
    if (!fresh && matches[i]->correlation > matches[place->second]->correlation) place->second = i;
  }
  std::vector<TieObservation> observations;
  for (const auto& [key, index] : best)
    observations.push_back(observation_of(*matches[index], key.second, key.first));
  return observations;
}

}  // namespace

Result<std::vector<TieObservation>> transfer_picks(const GreyImageSource& photos, int photo_count,
                                                   const std::vector<Pick>& picks,
                                                   const TiePoints& ties,
                                                   const TieOptions& options) {
  try {
    cv::setNumThreads(1);
    std::vector<PhotoLevels> levels;
    const Status loaded = load_photos(photos, photo_count, options.threads, {}, levels);
    if (!loaded) return loaded.error();
    const Predictors predictors = predictors_for(picks, ties, levels);
    const std::vector<Job> jobs = jobs_for(picks, photo_count, predictors);
    std::vector<std::optional<PatchMatch>> matches(jobs.size());
    parallel_for(static_cast<int>(jobs.size()), options.threads, [&](int i) {
      const Job& job = jobs[static_cast<std::size_t>(i)];
      matches[static_cast<std::size_t>(i)] =
          find_pick(levels[static_cast<std::size_t>(job.pick.photo)],
                    levels[static_cast<std::size_t>(job.target)], job.pick, *job.predictor);
    });
    return best_of(jobs, matches);
  } catch (const std::exception& error) {
    return Error{std::string("Transferring picks failed inside a library (") + error.what() +
                 "); measure these points by hand in every photo."};
  }
}

}  // namespace plumbline::image
