// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "edge/orient/adjust.h"
#include "tests/accuracy/bound.h"

namespace plumbline::accuracy {

// How often something lay within one and two stated sigmas.
struct Shares {
  int count = 0, within_one = 0, within_two = 0;

  void add(double error, double variance);
  double one() const { return static_cast<double>(within_one) / count; }
  double two() const { return static_cast<double>(within_two) / count; }
  void operator+=(const Shares& other);
};

// Squared errors beside the squared sigmas of the bound, by axis (east, north, up).
struct AgainstBound {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d bound = Eigen::Vector3d::Zero();
  int points = 0;

  Eigen::Vector3d rmse_m() const { return (squares / points).cwiseSqrt(); }
  Eigen::Vector3d bound_m() const { return (bound / points).cwiseSqrt(); }
  double ratio() const { return std::sqrt(squares.sum() / bound.sum()); }
  double ratio(int axis) const { return std::sqrt(squares[axis] / bound[axis]); }
  void operator+=(const AgainstBound& other);
};

// What many flights of one kind showed: errors beside the bound, beside what was stated, and
// beside the plainest guess there is (ground flat at its mean height).
struct Tally {
  int trials = 0, failed = 0, unconverged = 0;
  AgainstBound absolute;    // targets in the frame of the stations
  AgainstBound local;       // after the best-fit similarity
  double flat_squares = 0;  // heights of the same targets, about their mean: what "flat" scores
  Shares points, poses;
  Shares local_points;
  Shares focal_length, azimuth;
  double nees = 0;
  int nees_dof = 0;
  int targets_given = 0, targets_measured = 0;
  int accepted = 0, accepted_gross = 0;
  int azimuth_declared = 0;  // flights in which the azimuth was declared not observable

  void operator+=(const Tally& other);
};

// One flight adjusted and compared.
Tally fly(const orient::testing::FlightPlan& plan, std::uint64_t seed,
          const orient::Options& options);

// `trials` flights with seeds first_seed, first_seed + 1, ...; the same whatever `threads` is.
Tally fly_many(const orient::testing::FlightPlan& plan, int trials, std::uint64_t first_seed,
               const orient::Options& options, int threads);

}  // namespace plumbline::accuracy
