// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "edge/orient/network/normal_equations.h"
#include "edge/orient/network/step.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient::testing {

// A climb small enough for dense matrices, with everything known that can be known, linearised
// away from its minimum: tilts of degrees, points and camera off by a little.
struct SmallNetwork {
  explicit SmallNetwork(std::uint64_t seed, int targets = 10);
  SmallNetwork(const SmallNetwork&) = delete;
  SmallNetwork& operator=(const SmallNetwork&) = delete;

  // After a change of the problem's observations.
  void tie_again() { network = make_network(problem, network.photo_of_slot); }

  Problem problem;
  Network network;
  State state;
  State datum;
  TermOptions options;
};

// All unknowns in one vector: the reduced columns, then three for every eliminated point.
class DenseSystem {
 public:
  // Of `rays` and `terms`, from their own definitions; parameters held fixed have no columns here.
  DenseSystem(const Network& network, const std::vector<RayLinear>& rays,
              const std::vector<Term>& terms);

  const Eigen::MatrixXd& normal() const { return normal_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }
  // Inverse with zero rows and columns for the parameters held fixed.
  Eigen::MatrixXd covariance() const;
  Step step() const;
  int column_of_point(int point) const { return point_column_[static_cast<std::size_t>(point)]; }

 private:
  void add(const std::vector<int>& columns, const Eigen::MatrixXd& jacobian,
           const Eigen::MatrixXd& information, const Eigen::VectorXd& residual);
  std::vector<int> adjusted() const;

  const Network& network_;
  std::vector<int> point_column_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
};

// The state with one unknown of the reduced system moved.
State nudged(const Network& network, const State& state, int column, double by);

}  // namespace plumbline::orient::testing
