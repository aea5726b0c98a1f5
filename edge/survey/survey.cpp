// SPDX-License-Identifier: MIT
#include "edge/survey/survey.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "edge/base/median.h"

namespace plumbline::survey {
namespace {

// A match's own sigma tells good texture from poor, but not as widely as it claims: what it cannot
// know (relief inside the patch, shadows) is common to all.
constexpr double kLeastRelativeSigma = 0.7;
constexpr double kMostRelativeSigma = 2.0;

double sigma_of(const image::TieObservation& tie) {
  return std::sqrt(0.5 * tie.covariance_px2.trace());
}

double median_sigma(const std::vector<image::TieObservation>& ties) {
  std::vector<double> sigmas;
  for (const auto& tie : ties) {
    if (const double sigma = sigma_of(tie); std::isfinite(sigma)) sigmas.push_back(sigma);
  }
  const double middle = upper_median(std::move(sigmas));
  return middle > 0 ? middle : 1;
}

double relative_sigma(const image::TieObservation& tie, double median) {
  const double relative = sigma_of(tie) / median;
  if (!std::isfinite(relative)) return kMostRelativeSigma;
  return std::clamp(relative, kLeastRelativeSigma, kMostRelativeSigma);
}

// Builds the problem: named points first, then ties.
class ProblemMaker {
 public:
  explicit ProblemMaker(const Input& input) : input_(input) {
    problem_.camera = input.camera;
    problem_.photos = input.photos;
    problem_.gnss = input.gnss;
    problem_.lever_arm = input.lever_arm;
    problem_.delay = input.delay;
    for (const NamedPick& pick : input.picks) add_pick(pick);
  }

  // Points measured by hand in one photo only: the others are found by matching.
  std::vector<image::Pick> lone_picks() const {
    std::map<int, int> picks_of_point;
    for (const auto& o : problem_.observations) ++picks_of_point[o.point];
    std::vector<image::Pick> lone;
    for (const auto& o : problem_.observations) {
      if (picks_of_point[o.point] == 1) lone.push_back({o.photo, o.point, o.pixel});
    }
    return lone;
  }

  void add_matches(const std::vector<image::TieObservation>& matches, int first_point) {
    const double median = median_sigma(matches);
    for (const auto& tie : matches) {
      problem_.observations.push_back({tie.photo, first_point + tie.point, tie.pixel,
                                       relative_sigma(tie, median), orient::ImageGroup::kTies});
    }
  }

  void add_ties(const image::TiePoints& ties) {
    const int first = static_cast<int>(problem_.point_names.size());
    const std::string prefix = tie_prefix();
    for (int i = 1; i <= ties.point_count; ++i) {
      problem_.point_names.push_back(prefix + std::to_string(i));
    }
    add_matches(ties.observations, first);
  }

  Result<orient::Problem> finish() {
    for (const NamedLength& length : input_.lengths) {
      const int a = find(length.point_a), b = find(length.point_b);
      if (a < 0 || b < 0) {
        return Error{"The known length " + length.point_a + " to " + length.point_b +
                     " names a point that was not picked in any photo: " +
                     (a < 0 ? length.point_a : length.point_b) + "."};
      }
      problem_.lengths.push_back({a, b, length.metres, length.sigma_m});
    }
    for (const NamedControl& control : input_.control) {
      const int point = find(control.point);
      if (point >= 0) problem_.control.push_back({point, control.in_enu_m, control.covariance_m2});
    }
    return std::move(problem_);
  }

 private:
  void add_pick(const NamedPick& pick) {
    const auto [entry, is_new] =
        index_.try_emplace(pick.point, static_cast<int>(problem_.point_names.size()));
    if (is_new) problem_.point_names.push_back(pick.point);
    const auto group = pick.sigma_px ? orient::ImageGroup::kStated : orient::ImageGroup::kPicks;
    problem_.observations.push_back(
        {pick.photo, entry->second, pick.pixel, pick.sigma_px.value_or(1.0), group});
  }

  int find(const std::string& name) const {
    const auto entry = index_.find(name);
    return entry == index_.end() ? -1 : entry->second;
  }

  // Ties are T1, T2, ... unless a named point is called so already.
  std::string tie_prefix() const {
    std::string prefix = "T";
    const auto taken = [&](const auto& entry) { return entry.first.starts_with(prefix); };
    while (std::any_of(index_.begin(), index_.end(), taken)) prefix += "T";
    return prefix;
  }

  const Input& input_;
  orient::Problem problem_;
  std::map<std::string, int> index_;
};

Status check_overlap(const image::TiePoints& ties, std::size_t picks) {
  if (ties.point_count > 0 || picks > 0) return Done{};
  return Error{
      "The photos do not overlap: no point of the ground was found in two of them. Photos "
      "of the same ground, from different heights, are needed."};
}

}  // namespace

Counts count(const orient::Problem& problem, const orient::Solution& solution) {
  Counts counts;
  counts.photos_given = static_cast<int>(problem.photos.size());
  counts.photos_used =
      static_cast<int>(std::count_if(solution.photos.begin(), solution.photos.end(),
                                     [](const auto& photo) { return photo.oriented; }));
  std::set<int> tie_points;
  for (const auto& o : problem.observations) {
    if (o.group == orient::ImageGroup::kTies) tie_points.insert(o.point);
  }
  for (const auto& o : problem.observations) {
    if (o.group != orient::ImageGroup::kTies) tie_points.erase(o.point);
  }
  for (const int point : tie_points) {
    const auto& measured = solution.points[static_cast<std::size_t>(point)];
    if (!measured.measured) continue;
    ++counts.tie_points;
    counts.tie_points_3plus += measured.rays >= 3 ? 1 : 0;
  }
  return counts;
}

Result<Survey> measure(const Input& input, const Options& options, const Progress& progress) {
  image::TieFinder finder;
  return measure(input, options, progress, finder);
}

namespace {

// Ties, and picks of one photo in the others.
Status find_matches(const Input& input, const Options& options, const Progress& progress,
                    image::TieFinder& finder, ProblemMaker& maker) {
  if (input.ties) {
    maker.add_ties(*input.ties);
    return Done{};
  }
  const int photos = static_cast<int>(input.photos.size());
  const auto ties = finder.find(input.images, photos, options.ties, progress);
  if (!ties) return ties.error();
  if (auto overlap = check_overlap(*ties, input.picks.size()); !overlap) return overlap;
  if (const auto lone = maker.lone_picks(); !lone.empty()) {
    progress("finding picks in the other photos", 0, 1);
    const auto found = image::transfer_picks(input.images, photos, lone, *ties, options.ties);
    if (!found) return found.error();
    maker.add_matches(*found, 0);
    progress("finding picks in the other photos", 1, 1);
  }
  maker.add_ties(*ties);
  return Done{};
}

}  // namespace

Result<Survey> measure(const Input& input, const Options& options, const Progress& progress,
                       image::TieFinder& finder) {
  ProblemMaker maker(input);
  if (Status found = find_matches(input, options, progress, finder, maker); !found) {
    return found.error();
  }
  auto problem = maker.finish();
  if (!problem) return problem.error();
  progress("adjusting", 0, 1);
  auto solution = orient::adjust(*problem, options.adjustment);
  if (!solution) return solution.error();
  progress("adjusting", 1, 1);
  Survey survey{std::move(*problem), std::move(*solution), {}};
  survey.counts = count(survey.problem, survey.solution);
  return survey;
}

}  // namespace plumbline::survey
