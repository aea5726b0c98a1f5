// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/reliability/claims.h"

namespace plumbline::orient {

// What a robust stage starts from: lengths and control speak softly first, since a wrong one would
// otherwise drown the rays of its point.
void soften_claims(const Network& network, const State& state, TermOptions& options);

// Their weights in the robust stage, from their residuals (Cauchy). Stations:
// robust_station_weights.
void reweigh_claims(const Network& network, const State& state, TermOptions& options);

// Finds claims that the rest contradicts, one at a time, the worst first (data snooping, Baarda
// 1968), and takes back one that, with the truly wrong ones gone, is not contradicted any more.
class Doubts {
 public:
  // Rejects the worst claim that the rest contradicts. True where there was one: adjust again.
  // Of the calibration the focal length alone is tested.
  bool reject_worst(const Network& network, const NetworkCovariance& covariance, const Terms& terms,
                    TermOptions& options);
  // The same after a plain adjustment at `state`; where nothing is to be rejected, takes one back.
  bool revise(const Network& network, const State& state, const State& start,
              const NetworkCovariance& covariance, const Terms& terms, TermOptions& options);

  const std::vector<Claim>& rejected() const { return rejected_; }

 private:
  bool reject_worst(const std::vector<ClaimTest>& tests, const Network& network,
                    TermOptions& options);
  bool take_one_back(const Network& network, const State& state, const State& start,
                     const NetworkCovariance& covariance, double family, TermOptions& options);
  bool may_reject(const Claim& claim, const Network& network, const TermOptions& options) const;

  std::vector<Claim> rejected_;
  std::vector<Claim> taken_back_;
};

}  // namespace plumbline::orient
