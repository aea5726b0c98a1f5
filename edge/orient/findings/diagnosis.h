// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "edge/orient/network/terms.h"
#include "edge/orient/options.h"
#include "edge/orient/precision/local_frame_fit.h"

namespace plumbline::orient {

// What the adjustment knows of itself at its end.
struct Evidence {
  const Network& network;
  const State& state;
  const TermOptions& terms;
  const NetworkCovariance& covariance;
  const LocalFrameFit& frame;
};

CommonSigmas common_sigmas(const Evidence& evidence, double flying_height_m);

// Names what the data do not fix, each with what would.
std::vector<Unobservable> unobservable(const Evidence& evidence, const CommonSigmas& sigmas,
                                       const Options& options);

// Sentences on what rests on poor or single evidence without being unobservable.
std::vector<std::string> cautions(const Evidence& evidence, const CommonSigmas& sigmas);

}  // namespace plumbline::orient
