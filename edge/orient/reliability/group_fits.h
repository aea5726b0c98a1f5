// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"
#include "edge/orient/precision/covariance.h"

namespace plumbline::orient {

// The sum of weighted squared residuals of a group and its share of the redundancy.
struct GroupFit {
  double squares = 0;
  double redundancy = 0;
  int observations = 0;
};
// ties, picks, stated, and the groups of the terms. Redundancy of a group: its observations minus
// tr(A Q A' P) (Foerstner 1979).
using GroupFits = std::map<std::string, GroupFit>;

std::string name_of(ImageGroup group);

// Rescales the sigmas of image groups whose sigma nobody stated by the median of their residuals:
// a first, robust estimate.
void rescale_by_median(Network& network, const State& state);

GroupFits group_fits(const Network& network, const NetworkCovariance& covariance,
                     const std::vector<RayLinear>& rays, const std::vector<Term>& terms);

// Rescales them by their estimated variance components. Returns the largest relative change.
double rescale_by_variance(Network& network, const GroupFits& fits);

}  // namespace plumbline::orient
