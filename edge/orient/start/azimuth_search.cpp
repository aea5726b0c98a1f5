// SPDX-License-Identifier: MIT
#include "edge/orient/start/azimuth_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "edge/orient/network/rays.h"
#include "edge/orient/network/stations.h"
#include "edge/orient/start/align.h"

namespace plumbline::orient {
namespace {

// More than this share of the stations beyond so many sigmas is a contradiction,
constexpr double kContradictedShare = 0.25;
constexpr double kContradictionSigmas = 5;
// and so is a robust cost of the rays beyond this many times what good ones cost.
constexpr double kCostRatio = 3;
constexpr double kMostSquares = 1e10;
constexpr int kAzimuthsTried = 8;
// So many rays beyond so many sigmas: rather a wrong place than mismatches.
constexpr double kManyOff = 1.0 / 3;
constexpr double kOffSigmas = 5;
// From level photos an eighth of a turn off, a point is seen a hundred pixels from where it is.
constexpr double kScalesFromAfar[] = {100, 20};
constexpr int kIterationsFromAfar = 30;
constexpr double kToleranceFromAfar = 1e-4;
// Photos so few may have been oriented to each other wrongly without any contradiction.
constexpr int kFewPhotos = 3;
// A cost beyond its expectation by so many of its standard deviations is a doubt.
constexpr double kDoubtSigmas = 3;
// So many points tell whether another start leads lower; all are needed only where it does.
constexpr int kPointsToTry = 300;
// Descents into the same valley end within this share of its cost.
constexpr double kSameCost = 1e-4;

Descent descend(const Network& network, State start, const TermOptions& terms,
                const MinimiseOptions& options) {
  State from = start;
  replant_wild_points(network, from);
  Minimum end = minimise(network, from, start, terms, options);
  return {std::move(start), std::move(end)};
}

// By what the sigmas were taken for before anything was learnt from residuals.
double first_squared_sigmas(const Network& network, const Ray& ray, const State& state) {
  Ray unlearnt = ray;
  unlearnt.sigma_px = first_sigma(network.problem->observations[at(ray.observation)]);
  return squared_sigmas(unlearnt, state);
}

bool stations_contradict(const Network& network, const State& state, const TermOptions& terms) {
  const std::vector<double> weights = robust_station_weights(network, state);
  const double beyond = station_weight_at(kContradictionSigmas);
  const std::vector<int> slots = station_slots(network, terms);
  const auto bad = std::count_if(slots.begin(), slots.end(),
                                 [&](int slot) { return weights[at(slot)] < beyond; });
  return static_cast<double>(bad) > kContradictedShare * static_cast<double>(slots.size());
}

bool rays_contradict(const Network& network, const State& state, double cauchy_scale) {
  const double c2 = cauchy_scale * cauchy_scale;
  double cost = 0, expected = 0;
  for (const Ray& ray : network.rays) {
    if (!ray.used) continue;
    const double squares = first_squared_sigmas(network, ray, state);
    cost += c2 * std::log1p(std::min(squares, kMostSquares) / c2);
    expected += 2;
  }
  return cost > kCostRatio * expected;
}

bool many_off(const Network& network, const State& state) {
  int used = 0, off = 0;
  for (const Ray& ray : network.rays) {
    if (!ray.used) continue;
    ++used;
    off += first_squared_sigmas(network, ray, state) > kOffSigmas * kOffSigmas ? 1 : 0;
  }
  return off > kManyOff * used;
}

// A doubt is less than a contradiction: images and priors cost together more than their degrees of
// freedom make likely. A photo adds six unknowns and at least three things known, its station.
bool doubtful(const Network& network, const Descent& descent) {
  int points = 0, rays = 0;
  for (int p = 0; p < network.points(); ++p) {
    points += used_rays(network, p) > 0 ? 1 : 0;
    rays += used_rays(network, p);
  }
  const double dof = 2 * rays - 3 * points - 3 * network.slots();
  return dof > 0 && descent.end.cost > dof + kDoubtSigmas * std::sqrt(2 * dof);
}

// The same network with about `wanted` of its points, evenly from all groups; those that lengths
// and control name are kept.
Network thinned(const Network& network, int wanted) {
  Network thin = network;
  const double share = static_cast<double>(wanted) / network.points();
  double due = 0;
  for (PointGroup& group : thin.groups) {
    if (group.kept) continue;
    std::vector<int> points;
    for (const int p : group.points) {
      due += share;
      if (due >= 1) {
        points.push_back(p);
        due -= 1;
      } else {
        for (int k = thin.first_ray[at(p)]; k < thin.first_ray[at(p) + 1]; ++k)
          thin.rays[at(k)].used = false;
      }
    }
    group.points = std::move(points);
  }
  return thin;
}

// The lowest of descents from several starts.
class LowestDescent {
 public:
  LowestDescent(const Network& network, State start, const TermOptions& terms,
                const MinimiseOptions& options)
      : network_(network),
        terms_(terms),
        options_(options),
        lowest_(descend(network, std::move(start), terms, options)),
        iterations_(lowest_.end.iterations) {}

  void try_from(State start) {
    if (network_.points() <= kPointsToTry) return descend_from(std::move(start));
    thin_out();
    const double cost = descend(*few_points_, start, terms_, options_).end.cost;
    if (!(cost < cost_of_few_ * (1 - kSameCost))) return;
    cost_of_few_ = cost;
    descend_from(std::move(start));
  }

  // The same from a start so crude that a sharp scale would see nothing but mismatches.
  void try_from_crude(const State& start) {
    const bool many = network_.points() > kPointsToTry;
    if (many) thin_out();
    const Network& tried = many ? *few_points_ : network_;
    State from = start;
    for (const double scale : kScalesFromAfar) {
      replant_wild_points(tried, from);
      const MinimiseOptions crude{scale, kIterationsFromAfar, kToleranceFromAfar};
      from = minimise(tried, from, start, terms_, crude).state;
    }
    if (many) replant_points(network_, from);
    try_from(std::move(from));
  }

  bool in_doubt() const {
    return doubtful(network_, lowest_) ||
           stations_contradict(network_, lowest_.end.state, terms_) ||
           rays_contradict(network_, lowest_.end.state, options_.cauchy_scale);
  }
  bool many_rays_off() const { return many_off(network_, lowest_.end.state); }

  const State& start() const { return lowest_.start; }

  // With the iterations of all descents of all points.
  Descent take() && {
    lowest_.end.iterations = iterations_;
    return std::move(lowest_);
  }

 private:
  void thin_out() {
    if (few_points_) return;
    few_points_ = thinned(network_, kPointsToTry);
    cost_of_few_ = descend(*few_points_, lowest_.start, terms_, options_).end.cost;
  }

  void descend_from(State start) {
    Descent other = descend(network_, std::move(start), terms_, options_);
    iterations_ += other.end.iterations;
    if (other.end.cost < lowest_.end.cost) lowest_ = std::move(other);
  }

  const Network& network_;
  const TermOptions& terms_;
  const MinimiseOptions& options_;
  Descent lowest_;
  int iterations_;
  std::optional<Network> few_points_;
  double cost_of_few_ = 0;
};

}  // namespace

Descent descend_around_circle(const Network& network, const State& free, const TermOptions& terms,
                              const MinimiseOptions& options) {
  LowestDescent lowest(network, aligned(network, free, terms), terms, options);
  if (network.slots() <= kFewPhotos || lowest.in_doubt()) {
    lowest.try_from(levelled(network, lowest.start(), terms));
  }
  if (lowest.in_doubt()) {
    for (State& start : aligned_all_around(network, free, terms, kAzimuthsTried))
      lowest.try_from(std::move(start));
  }
  if (lowest.many_rays_off()) {
    for (const State& start : aligned_all_around(network, free, terms, kAzimuthsTried))
      lowest.try_from_crude(levelled(network, start, terms));
  }
  return std::move(lowest).take();
}

}  // namespace plumbline::orient
