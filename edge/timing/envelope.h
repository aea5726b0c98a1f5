// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace plumbline::timing {

// A delay, seconds, at a time, seconds; both about a common origin.
struct DelayPoint {
  double time_s = 0;
  double delay_s = 0;
};

// The line below the points: its value at time 0, its slope, their covariance.
struct Envelope {
  double value_s = 0;
  double slope = 0;
  double variance_s2 = 0;
  double covariance_s = 0;
  double slope_variance = 0;
};

// The floor line of delays that are a line plus something positive of unknown law.
//
// Near the floor the points are a Poisson process whose density (points per second of delay) is
// about even, which is exact for exponential and uniform laws. Then for a slope d the floor lies
// below env(d) = min(delay - d time) by an exponential of the inverse density, and the slope has
// the likelihood exp(-density * area between the points' centre and env). The inverse density is
// the distance of the lowest point from where the law begins, as the lowest fifth of the points
// tells it, with its sigma: floor_gap.h, which knows laws that begin thinly, too. The tail says
// nothing about the floor. Posterior mean and covariance over the slope are by numerical
// integration, with a normal prior of `slope_sigma` about 0.
//
// `points`: one or more, any order.
Envelope lower_envelope(std::span<const DelayPoint> points, double slope_sigma);

// The same for one series after the other, in memory that is taken once.
class EnvelopeFinder {
 public:
  explicit EnvelopeFinder(std::size_t most_points);

  // At most so many points.
  Envelope find(std::span<const DelayPoint> points, double slope_sigma);

 private:
  std::vector<DelayPoint> sorted_, hull_;
  std::vector<double> above_;
};

}  // namespace plumbline::timing
