// SPDX-License-Identifier: MIT
#include "edge/timing/envelope.h"

#include <algorithm>
#include <cmath>

#include "edge/timing/floor_gap.h"

namespace plumbline::timing {
namespace {

// The share of the points, the lowest, that the floor is judged by, and the fewest of them.
constexpr std::size_t kOneIn = 5;
constexpr std::size_t kFewest = 8;
// Less is not believed: the kernel's timer.
constexpr double kLeastGap_s = 0.1e-3;
// A tail that is believed before there are points to tell: it counts as one point.
constexpr double kUsualTail_s = 20e-3;
constexpr double kSlopeLimitSigmas = 4;

// The only points that a line from below can touch: the lower convex hull, by time (Andrew 1979,
// "Another efficient algorithm for convex hulls in two dimensions"). Some ten of a hundred.
void lower_hull(std::vector<DelayPoint>& points, std::vector<DelayPoint>& hull) {
  std::sort(points.begin(), points.end(), [](const DelayPoint& a, const DelayPoint& b) {
    return a.time_s != b.time_s ? a.time_s < b.time_s : a.delay_s < b.delay_s;
  });
  const auto turns_up = [](const DelayPoint& a, const DelayPoint& b, const DelayPoint& c) {
    return (b.time_s - a.time_s) * (c.delay_s - a.delay_s) >
           (b.delay_s - a.delay_s) * (c.time_s - a.time_s);
  };
  hull.clear();
  for (const DelayPoint& point : points) {
    while (hull.size() > 1 && !turns_up(hull[hull.size() - 2], hull.back(), point)) {
      hull.pop_back();
    }
    hull.push_back(point);
  }
}

class SlopeLikelihood {
 public:
  // `hull`: of the points; `above`: room for as many.
  SlopeLikelihood(std::span<const DelayPoint> points, const std::vector<DelayPoint>& hull,
                  double slope_sigma, std::vector<double>& above)
      : points_(points), hull_(hull), above_(above), slope_sigma_(slope_sigma) {
    for (const DelayPoint& point : points) {
      mean_time_s_ += point.time_s / static_cast<double>(points.size());
      mean_delay_s_ += point.delay_s / static_cast<double>(points.size());
    }
    const auto count = static_cast<double>(points.size());
    density_per_s_ = 1 / std::max(kLeastGap_s, (cost_at_density_one(0) + kUsualTail_s) / count);
  }

  // The lowest line of that slope: its value at time 0.
  double env_s(double slope) const {
    double least = hull_.front().delay_s - slope * hull_.front().time_s;
    for (const DelayPoint& point : hull_) {
      least = std::min(least, point.delay_s - slope * point.time_s);
    }
    return least;
  }

  // Minus the logarithm of the posterior; convex.
  double cost(double slope) const {
    const double sigmas = slope / slope_sigma_;
    return density_per_s_ * cost_at_density_one(slope) + 0.5 * sigmas * sigmas;
  }

  const FloorGap& gap() const { return gap_; }
  double slope_limit() const { return kSlopeLimitSigmas * slope_sigma_; }

  // The density at the floor, seen from the best line so far.
  void take_density_about(double slope) {
    const double lowest_s = env_s(slope);
    above_.clear();
    for (const DelayPoint& point : points_) {
      above_.push_back(point.delay_s - slope * point.time_s - lowest_s);
    }
    std::sort(above_.begin(), above_.end());
    above_.resize(std::min(above_.size(), std::max(kFewest, above_.size() / kOneIn)));
    gap_ = floor_gap(above_);
    density_per_s_ = 1 / std::max(kLeastGap_s, gap_.mean_s);
  }

 private:
  double cost_at_density_one(double slope) const {
    return mean_delay_s_ - slope * mean_time_s_ - env_s(slope);
  }

  std::span<const DelayPoint> points_;
  const std::vector<DelayPoint>& hull_;
  std::vector<double>& above_;
  double slope_sigma_;
  double mean_time_s_ = 0;
  double mean_delay_s_ = 0;
  double density_per_s_ = 0;
  FloorGap gap_;
};

double best_slope(const SlopeLikelihood& likelihood) {
  double low = -likelihood.slope_limit();
  double high = likelihood.slope_limit();
  for (int i = 0; i < 40; ++i) {
    const double third = (high - low) / 3;
    if (likelihood.cost(low + third) < likelihood.cost(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return (low + high) / 2;
}

// How far from `best` the cost has risen by so much that nothing beyond counts.
double reach(const SlopeLikelihood& likelihood, double best, double direction) {
  constexpr double kEnough = 12;
  const double least = likelihood.cost(best);
  double inside = 0;
  double outside = 2 * likelihood.slope_limit();
  for (int i = 0; i < 30; ++i) {
    const double middle = (inside + outside) / 2;
    const bool counts = likelihood.cost(best + direction * middle) < least + kEnough;
    (counts ? inside : outside) = middle;
  }
  return outside;
}

Envelope mean_over_slopes(const SlopeLikelihood& likelihood, double best) {
  constexpr int kSteps = 48;
  const double from = best - reach(likelihood, best, -1);
  const double to = best + reach(likelihood, best, 1);
  double weight = 0;
  double value = 0;
  double slope = 0;
  double value2 = 0;
  double both = 0;
  double slope2 = 0;
  const double env0 = likelihood.env_s(best);
  for (int i = 0; i < kSteps; ++i) {
    const double d = from + (to - from) * (i + 0.5) / kSteps - best;
    const double w = std::exp(likelihood.cost(best) - likelihood.cost(best + d));
    const double v = likelihood.env_s(best + d) - env0;
    weight += w;
    value += w * v;
    slope += w * d;
    value2 += w * v * v;
    both += w * v * d;
    slope2 += w * d * d;
  }
  value /= weight;
  slope /= weight;
  Envelope envelope;
  envelope.value_s = env0 + value - likelihood.gap().mean_s;
  envelope.slope = best + slope;
  envelope.variance_s2 = value2 / weight - value * value +
                         likelihood.gap().sigma_s * likelihood.gap().sigma_s +
                         kLeastGap_s * kLeastGap_s;
  envelope.covariance_s = both / weight - value * slope;
  envelope.slope_variance = slope2 / weight - slope * slope;
  return envelope;
}

}  // namespace

EnvelopeFinder::EnvelopeFinder(std::size_t most_points) {
  sorted_.reserve(most_points);
  hull_.reserve(most_points);
  above_.reserve(most_points);
}

Envelope EnvelopeFinder::find(std::span<const DelayPoint> points, double slope_sigma) {
  sorted_.assign(points.begin(), points.end());
  lower_hull(sorted_, hull_);
  SlopeLikelihood likelihood(points, hull_, slope_sigma, above_);
  double best = best_slope(likelihood);
  for (int i = 0; i < 2; ++i) {
    likelihood.take_density_about(best);
    best = best_slope(likelihood);
  }
  return mean_over_slopes(likelihood, best);
}

Envelope lower_envelope(std::span<const DelayPoint> points, double slope_sigma) {
  return EnvelopeFinder(points.size()).find(points, slope_sigma);
}

}  // namespace plumbline::timing
