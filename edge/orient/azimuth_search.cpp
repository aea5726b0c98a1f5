// SPDX-License-Identifier: MIT
#include "edge/orient/azimuth_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "edge/orient/align.h"
#include "edge/orient/rays.h"
#include "edge/orient/stations.h"

namespace plumbline::orient {
namespace {

// More than this share of the stations beyond so many sigmas is a contradiction,
constexpr double kContradictedShare = 0.25;
constexpr double kContradictionSigmas = 5;
// and so is a robust cost of the rays beyond this many times what good ones cost.
constexpr double kCostRatio = 3;
constexpr double kMostSquares = 1e10;
constexpr int kAzimuthsTried = 8;
// Photos so few may have been oriented to each other wrongly without any contradiction.
constexpr int kFewPhotos = 3;
// A cost beyond its expectation by so many of its standard deviations is a doubt.
constexpr double kDoubtSigmas = 3;

Descent descend(const Network& network, State start, const TermOptions& terms,
                const MinimiseOptions& options) {
  State from = start;
  replant_wild_points(network, from);
  Minimum end = minimise(network, from, start, terms, options);
  return {std::move(start), std::move(end)};
}

bool stations_contradict(const Network& network, const State& state, const TermOptions& terms) {
  const std::vector<double> weights = robust_station_weights(network, state);
  const double beyond = station_weight_at(kContradictionSigmas);
  const std::vector<int> slots = station_slots(network, terms);
  const auto bad = std::count_if(slots.begin(), slots.end(),
                                 [&](int slot) { return weights[at(slot)] < beyond; });
  return static_cast<double>(bad) > kContradictedShare * static_cast<double>(slots.size());
}

// By what the sigmas were taken for before anything was learnt from residuals.
bool rays_contradict(const Network& network, const State& state, double cauchy_scale) {
  const double c2 = cauchy_scale * cauchy_scale;
  double cost = 0, expected = 0;
  for (const Ray& ray : network.rays) {
    if (!ray.used) continue;
    Ray unlearnt = ray;
    unlearnt.sigma_px = first_sigma(network.problem->observations[at(ray.observation)]);
    cost += c2 * std::log1p(std::min(squared_sigmas(unlearnt, state), kMostSquares) / c2);
    expected += 2;
  }
  return cost > kCostRatio * expected;
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

void keep_lower(Descent&& other, int& iterations, Descent& best) {
  iterations += other.end.iterations;
  if (other.end.cost < best.end.cost) best = std::move(other);
}

}  // namespace

Descent descend_around_circle(const Network& network, const State& free, const TermOptions& terms,
                              const MinimiseOptions& options) {
  Descent best = descend(network, aligned(network, free, terms), terms, options);
  int iterations = best.end.iterations;
  const auto in_doubt = [&] {
    return doubtful(network, best) || stations_contradict(network, best.end.state, terms) ||
           rays_contradict(network, best.end.state, options.cauchy_scale);
  };
  if (network.slots() <= kFewPhotos || in_doubt()) {
    keep_lower(descend(network, levelled(network, best.start, terms), terms, options), iterations,
               best);
  }
  if (in_doubt()) {
    for (State& start : aligned_all_around(network, free, terms, kAzimuthsTried))
      keep_lower(descend(network, std::move(start), terms, options), iterations, best);
  }
  best.end.iterations = iterations;
  return best;
}

}  // namespace plumbline::orient
