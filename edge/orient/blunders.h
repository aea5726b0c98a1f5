// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "edge/orient/covariance.h"
#include "edge/orient/network.h"
#include "edge/orient/terms.h"

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

// Rejects rays beyond `sigmas`, takes back those that have come within, and drops points left with
// one ray that nothing else holds. Returns how many rays changed sides.
int reject_rays(Network& network, const State& state, double sigmas);

// Drops for good the points whose rays, poses given, leave them a sigma beyond `limit_m`. Returns
// how many.
int drop_undetermined(Network& network, const NormalEquations& equations, double limit_m);

// Before a stage: a point that mismatches have thrown far above or below the ground goes back to
// the median of its rays' intersections with the ground plane; left near its cameras it would
// block every step.
void replant_wild_points(const Network& network, State& state);

// Before a stage: sets aside rays that cannot be projected at all.
void drop_unprojectable(Network& network, const State& state);

// Weights of the stations in the robust stage (Cauchy over each 3-vector).
std::vector<double> robust_station_weights(const Network& network, const State& state);

// The station whose residual disagrees most with what the rest predicts, by the chi-square test of
// its 3-vector at 0.1 % (1 % in a flight of ten photos); -1 where none does. Directions in which
// the rest cannot check it do not count (Baarda 1968).
int suspicious_station(const Network& network, const State& state, const TermOptions& options,
                       const std::vector<Term>& terms, const NetworkCovariance& covariance);

}  // namespace plumbline::orient
