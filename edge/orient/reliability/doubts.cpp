// SPDX-License-Identifier: MIT
#include "edge/orient/reliability/doubts.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "edge/base/chi_square.h"
#include "edge/orient/network/stations.h"

namespace plumbline::orient {
namespace {

constexpr double kCauchySigmas = 3;
// In the first robust stage a known place or length counts for no more than a sigma of this share
// of the flying height (what the free network is good for), and for a tenth of its own at most:
// it holds the network, and does not drown the rays of its point.
constexpr double kSoftShare = 0.02;
constexpr double kSoftWeight = 0.01;

double cauchy(double squared) { return 1 / (1 + squared / (kCauchySigmas * kCauchySigmas)); }

double soft(double variance, double height_m) {
  const double sigma_m = kSoftShare * std::abs(height_m);
  return std::min(kSoftWeight, variance / (sigma_m * sigma_m));
}

bool contains(const std::vector<Claim>& claims, const Claim& claim) {
  return std::find(claims.begin(), claims.end(), claim) != claims.end();
}

int stations_given(const Network& network) {
  int count = 0;
  for (int slot = 0; slot < network.slots(); ++slot) count += network.photo(slot).station ? 1 : 0;
  return count;
}

}  // namespace

void soften_claims(const Network& network, const State& state, TermOptions& options) {
  const double height = flying_height(network, state);
  options.length_weights.clear();
  options.control_weights.clear();
  for (const Length& length : network.problem->lengths)
    options.length_weights.push_back(soft(length.sigma_m * length.sigma_m, height));
  for (const Control& control : network.problem->control)
    options.control_weights.push_back(soft(control.covariance_m2.diagonal().minCoeff(), height));
  for (auto* weights : {&options.length_weights, &options.control_weights}) {
    for (double& weight : *weights) weight = std::max(weight, 1e-8);
  }
}

void reweigh_claims(const Network& network, const State& state, TermOptions& options) {
  const Problem& problem = *network.problem;
  for (std::size_t i = 0; i < problem.lengths.size(); ++i) {
    const Length& length = problem.lengths[i];
    const double metres =
        (state.points[at(length.point_b)] - state.points[at(length.point_a)]).norm();
    const double sigma = std::max(length.sigma_m, 1e-4);
    options.length_weights[i] = cauchy(std::pow((metres - length.metres) / sigma, 2));
  }
  for (std::size_t i = 0; i < problem.control.size(); ++i) {
    const Control& control = problem.control[i];
    const Eigen::Vector3d miss = state.points[at(control.point)] - control.in_enu_m;
    const Eigen::Matrix3d spread = control.covariance_m2 + 1e-8 * Eigen::Matrix3d::Identity();
    options.control_weights[i] = cauchy(miss.dot(spread.inverse() * miss));
  }
}

bool Doubts::reject_worst(const Network& network, const NetworkCovariance& covariance,
                          const Terms& terms, TermOptions& options) {
  return reject_worst(test_claims(network, options, terms, covariance), network, options);
}

bool Doubts::revise(const Network& network, const State& state, const State& start,
                    const NetworkCovariance& covariance, const Terms& terms, TermOptions& options) {
  const std::vector<ClaimTest> tests = test_claims(network, options, terms, covariance);
  if (reject_worst(tests, network, options)) return true;
  return take_one_back(network, state, start, covariance, family_size(tests, options), options);
}

// Most stations must agree; lengths and control are checked by the stations, or not at all.
bool Doubts::may_reject(const Claim& claim, const Network& network,
                        const TermOptions& options) const {
  if (claim.kind != ClaimKind::kStation) return true;
  const int believed = static_cast<int>(station_slots(network, options).size());
  return believed >= kLeastStations && 3 * (believed - 1) >= 2 * stations_given(network);
}

bool Doubts::reject_worst(const std::vector<ClaimTest>& tests, const Network& network,
                          TermOptions& options) {
  std::optional<Claim> worst;
  double least = 0;
  for (const ClaimTest& test : tests) {
    const bool tested =
        test.claim.kind != ClaimKind::kInterior || test.claim.index == geometry::kFocalLength;
    if (!tested || !test.fails() || !may_reject(test.claim, network, options)) continue;
    const double log_share = chi_square_log_share_above(test.rows.statistic, test.rows.dof);
    if (worst && log_share >= least) continue;
    least = log_share;
    worst = test.claim;
  }
  if (!worst) return false;
  set_believed(*worst, false, network, options);
  rejected_.push_back(*worst);
  return true;
}

// Once each, so that nothing goes round in circles.
bool Doubts::take_one_back(const Network& network, const State& state, const State& start,
                           const NetworkCovariance& covariance, double family,
                           TermOptions& options) {
  for (const Claim& claim : rejected_) {
    if (contains(taken_back_, claim)) continue;
    const ClaimTest test = test_rejected(claim, network, state, start, options, covariance, family);
    if (test.rows.dof == 0 || test.fails()) continue;
    set_believed(claim, true, network, options);
    taken_back_.push_back(claim);
    std::erase(rejected_, Claim(claim));
    return true;
  }
  return false;
}

}  // namespace plumbline::orient
