// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/findings/diagnosis.h"
#include "edge/orient/options.h"
#include "edge/orient/precision/covariance.h"
#include "edge/orient/reliability/claims.h"
#include "edge/orient/reliability/group_fits.h"

namespace plumbline::orient {

// An adjustment at its end.
struct Finished {
  const Network& network;
  const State& state;
  const TermOptions& terms;
  const NetworkCovariance& covariance;  // straight: of the linearised adjustment, for its tests
  const NetworkCovariance& bars;        // what is stated of the unknowns
  const GroupFits& fits;
  const Terms& linear;  // the terms at `state`
  const State& start;   // what the datum holds on to
  std::vector<Claim> rejected;
  int iterations = 0;
  bool converged = false;
};

// Puts together what is handed to the user.
Solution solution_of(const Finished& finished, const Options& options);

}  // namespace plumbline::orient
