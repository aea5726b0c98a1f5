// SPDX-License-Identifier: MIT
#include "edge/orient/precision/bent_covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "edge/orient/network/minimise.h"
#include "edge/orient/network/step.h"
#include "edge/orient/precision/corrected_information.h"
#include "edge/orient/precision/point_twists.h"
#include "edge/orient/precision/weak_directions.h"

namespace plumbline::orient {
namespace {

// Directions known better than this bend by less than 0.2 mm in a picture of a hundred metres.
constexpr double kLeastAngleRad = 0.002;
constexpr std::size_t kMostDirections = 14;
// Pairs of directions whose product is less twist by less than 2 mm in a hundred metres.
constexpr double kLeastTwistRad2 = 2e-5;
constexpr double kFarthestRad = 2.5;
constexpr int kIterations = 60;
constexpr double kTolerance = 1e-7;
constexpr double kPinSigma = 0.02;  // of the direction's own

struct Node {
  double at_sigmas = 0;
  double weight = 0;
};
constexpr double kMiddleWeight = 8.0 / 15;
constexpr double kInner = 1.3556261799742659;
constexpr std::array<Node, 4> kNodes = {{{-2.8569700138728056, 0.011257411327720689},
                                         {-kInner, 0.22207592200561266},
                                         {kInner, 0.22207592200561266},
                                         {2.8569700138728056, 0.011257411327720689}}};

// How one place of the network lies from another, by column and by point.
Step displacement(const Network& network, const State& from, const State& to) {
  Step step{pin_displacement(network, from, to), {}};
  step.points.resize(to.points.size());
  for (std::size_t p = 0; p < to.points.size(); ++p) step.points[p] = to.points[p] - from.points[p];
  return step;
}

Step sum(Step a, const Step& b, double factor = 1) {
  a.common += factor * b.common;
  for (std::size_t p = 0; p < a.points.size(); ++p) a.points[p] += factor * b.points[p];
  return a;
}

// Where the network comes to lie, and how likely that is.
struct Place {
  double weight = 0;
  Step from_estimate;
};

// A direction that was followed to both sides.
struct Arc {
  WeakDirection direction;
  Step straight;              // one sigma of the straight covariance
  std::vector<Place> places;  // weights with that of the middle: 1
  double middle_weight = 1;
  Step mean;                // of the places, weighted
  std::optional<Step> sag;  // half the sum of the places at -kInner and +kInner sigmas
};

class Explorer {
 public:
  Explorer(const Network& network, const State& state, const State& datum, const TermOptions& terms,
           const NetworkCovariance& straight)
      : network_(network), state_(state), datum_(datum), terms_(terms), straight_(straight) {
    cost_ = cost_at(state);
  }

  // Empty where a place could not be reached: then the straight bar stays. Where the bar would
  // become shorter, the places count for more.
  std::optional<Arc> along(const WeakDirection& direction) const {
    Arc arc{direction, straight_step(direction), {}, kMiddleWeight, {}, {}};
    double total = kMiddleWeight, moment = 0;
    for (const Node& node : kNodes) {
      if (std::abs(node.at_sigmas) * direction.sigma_rad > kFarthestRad) continue;
      auto place = at_place({{&arc, node.at_sigmas}});
      if (!place) return std::nullopt;
      const double reached =
          direction.gradient.dot(place->from_estimate.common) / direction.sigma_rad;
      place->weight *= node.weight;
      total += place->weight;
      moment += place->weight * reached * reached;
      arc.places.push_back(std::move(*place));
    }
    // So poorly known that every place would be beyond half a turn.
    if (arc.places.empty()) return std::nullopt;
    const double stretch = std::max(1.0, total / moment);
    arc.mean = scaled(arc.straight, 0);
    arc.middle_weight /= total;
    for (Place& place : arc.places) {
      place.weight *= stretch / total;
      arc.mean = sum(std::move(arc.mean), place.from_estimate, place.weight);
    }
    if (arc.places.size() == kNodes.size())
      arc.sag = scaled(sum(arc.places[1].from_estimate, arc.places[2].from_estimate), 0.5);
    return arc;
  }

  // What a sigma of one and a sigma of another move beyond what each moves alone: the mixed second
  // derivative.
  std::optional<Step> twist(const Arc& a, const Arc& b) const {
    if (!a.sag || !b.sag) return std::nullopt;
    const auto both = at_place({{&a, kInner}, {&b, kInner}});
    const auto neither = at_place({{&a, -kInner}, {&b, -kInner}});
    if (!both || !neither) return std::nullopt;
    Step step = scaled(sum(both->from_estimate, neither->from_estimate), 0.5);
    step = sum(sum(std::move(step), *a.sag, -1), *b.sag, -1);
    return scaled(std::move(step), 1 / (kInner * kInner));
  }

 private:
  using Pulls = std::vector<std::pair<const Arc*, double>>;

  // Everything else adjusted to so many sigmas along each direction. The weight is what the
  // likelihood there is to that of a parabola. Empty where there is no such place.
  std::optional<Place> at_place(const Pulls& pulls) const {
    TermOptions pinned = terms_;
    State start = state_;
    for (const auto& [arc, sigmas] : pulls) {
      const auto& [gradient, sigma] = arc->direction;
      pinned.pins.push_back({gradient, state_, sigmas * sigma, kPinSigma * sigma});
      start = moved_by(network_, start, scaled(arc->straight, sigmas));
    }
    const Minimum found = minimise(network_, start, datum_, pinned, {0, kIterations, kTolerance});
    const double rise = cost_at(found.state) - cost_;
    if (!found.converged || !std::isfinite(rise)) return std::nullopt;
    Place place{0, displacement(network_, state_, found.state)};
    double parabola = 0;
    for (const auto& [arc, sigmas] : pulls) {
      const auto& [gradient, sigma] = arc->direction;
      parabola += std::pow(gradient.dot(place.from_estimate.common) / sigma, 2);
    }
    place.weight = std::exp(-0.5 * (std::max(rise, 0.0) - parabola));
    return place;
  }

  // One sigma along the direction, as the straight covariance has it.
  Step straight_step(const WeakDirection& direction) const {
    Step step{straight_.common() * direction.gradient / direction.sigma_rad, {}};
    step.points.assign(at(network_.points()), Eigen::Vector3d::Zero());
    for (int p = 0; p < network_.points(); ++p) {
      const PointFactor& factor = straight_.point(p);
      if (factor.measured) step.points[at(p)] = factor.by_common * step.common(factor.columns);
    }
    return step;
  }
  double cost_at(const State& state) const {
    return linearise_rays(network_, state, 0).cost +
           cost_of(linearised_terms(network_, state, datum_, terms_));
  }

  const Network& network_;
  const State& state_;
  const State& datum_;
  const TermOptions& terms_;
  const NetworkCovariance& straight_;
  double cost_ = 0;
};

// Puts the places of an arc, about their mean, in the stead of the straight line.
void bend_along(const Arc& arc, NetworkCovariance& covariance) {
  covariance.bend(-1, arc.straight);
  covariance.bend(arc.middle_weight, scaled(arc.mean, -1));
  for (const Place& place : arc.places)
    covariance.bend(place.weight, sum(place.from_estimate, arc.mean, -1));
}

// Whether what two arcs move together is followed by adjusting to places along both.
bool twist_is_followed(double sigma_rad, double other_sigma_rad) {
  return sigma_rad * other_sigma_rad >= kLeastTwistRad2;
}

void twist_points(const Network& network, const State& state, const NetworkCovariance& straight,
                  const std::vector<WeakDirection>& directions, const std::vector<Arc>& arcs,
                  NetworkCovariance& covariance) {
  for (const Arc& arc : arcs) {
    const double sigma_rad = arc.direction.sigma_rad;
    std::vector<WeakDirection> others;
    for (const WeakDirection& other : directions) {
      if (other.sigma_rad < sigma_rad && !twist_is_followed(sigma_rad, other.sigma_rad))
        others.push_back(other);
    }
    for (const Step& twist :
         point_twists(network, state, straight, arc.straight, sigma_rad, others))
      covariance.bend(1, twist);
  }
}

Step mean_of(const std::vector<Arc>& arcs) {
  Step mean = arcs.front().mean;
  for (std::size_t i = 1; i < arcs.size(); ++i) mean = sum(std::move(mean), arcs[i].mean);
  return mean;
}

}  // namespace

NetworkCovariance bent_covariance(const Network& network, const State& state, const State& datum,
                                  const TermOptions& terms, const NetworkCovariance& linear) {
  const NetworkCovariance straight = without_borrowed(network, state, datum, terms, linear);
  NetworkCovariance bent = straight;
  const Explorer explorer(network, state, datum, terms, straight);
  std::vector<Arc> arcs;
  const auto directions = weak_directions(network, state, straight.common());
  for (const WeakDirection& direction : directions) {
    if (direction.sigma_rad < kLeastAngleRad || arcs.size() == kMostDirections) break;
    auto arc = explorer.along(direction);
    if (!arc) continue;
    bend_along(*arc, bent);
    arcs.push_back(std::move(*arc));
  }
  if (!arcs.empty()) bent.bend(1, mean_of(arcs));
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!twist_is_followed(arcs[i].direction.sigma_rad, arcs[j].direction.sigma_rad)) continue;
      if (const auto twist = explorer.twist(arcs[i], arcs[j])) bent.bend(1, *twist);
    }
  }
  bent.add_next_order(linear);
  twist_points(network, state, straight, directions, arcs, bent);
  bent.turn_own_parts(network);
  return bent;
}

}  // namespace plumbline::orient
