// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "sim/random.h"

namespace plumbline::timing {

// How much later than at the least an epoch arrives (seconds, at least 0) that would be there at
// `host_s` of the host's clock. Called in order of time; may remember.
using ArrivalLaw = std::function<double(double host_s, sim::Random& random)>;

// Laws that the fit was not made with, each with a state of its own for every flight.
struct NamedLaw {
  std::string name;
  std::function<ArrivalLaw(sim::Random& random)> begun;
  std::chrono::milliseconds poll{1};  // what is known of the adapter
};

std::vector<NamedLaw> arrival_laws();

}  // namespace plumbline::timing
