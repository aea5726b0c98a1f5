// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "tests/accuracy/tally.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::accuracy {

// What is claimed of a kind of flight. Infinite or zero limits claim nothing.
struct Claim {
  double absolute_ratio = std::numeric_limits<double>::infinity();  // RMSE over bound
  double local_ratio = std::numeric_limits<double>::infinity();     // after a best fit
  double least_one = 0, most_one = 1;  // share of points and poses within one sigma
  double least_two = 0, most_two = 1;
  bool of_local = false;           // shares are those about the best fit: there is no other frame
  bool azimuth_declared = false;   // every flight says that its azimuth is not observable
  bool single_quantities = false;  // focal length and azimuth within the binomial interval
  bool joint = false;              // NEES of all points within its chi-square interval
  double accepted_gross = 1;       // share of the accepted observations
  Eigen::Vector3d rmse_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
};

// One kind of flight whose accuracy is claimed.
struct Condition {
  std::string name;  // of lower-case words, joined by hyphens
  orient::testing::FlightPlan plan;
  Claim claim;
};

// All conditions, with as many tie points as given.
std::vector<Condition> conditions(int ties);

// A sentence for each part of the claim that the flights did not bear out.
std::vector<std::string> shortcomings(const Claim& claim, const Tally& tally);

}  // namespace plumbline::accuracy
