// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/geometry/standard_accuracy.h"
#include "edge/plan/changes.h"
#include "edge/plan/flight.h"
#include "edge/plan/options.h"
#include "edge/plan/prediction.h"

namespace plumbline::plan {

// FRONT DOOR: what a flight will have measured, and what would make it better, before it is flown
// or while it is.

// A change and what the flight would be with it.
struct Advice {
  Change change;
  Sigma worst;  // of the worst ring within the radius
  std::optional<double> azimuth_deg;
  std::vector<std::string> unobservable;
  // Every ring within the goal; without a goal: fewer quantities left unobservable than by any
  // cheaper change.
  bool reaches_goal = false;
};

struct Summary {
  Prediction flight;  // as it stands
  double duration_s = 0;
  double radius_m = 0;               // of the ground that matters
  Sigma worst;                       // of the worst ring within it
  std::optional<bool> goal_reached;  // by the flight as it stands; empty without a goal
  // Kunii and Kumazaki 2018, eq. 6, at the mean flying height over the climb as base; empty where
  // all photos have one height.
  std::optional<geometry::StandardAccuracy> standard_accuracy;
  double mean_height_m = 0;     // H of eq. 6
  double base_m = 0;            // B of eq. 6
  std::vector<Advice> advice;   // by cost
  std::optional<int> cheapest;  // in `advice`: the first that reaches the goal
  std::optional<int> best;      // in `advice`: the smallest sigmas, where none reaches it
  std::string sentence;         // all of it in one
};

// Predicts the flight and every change of it. The search looks at representative ties; the flight
// itself and the change that is recommended are computed with all of them. Costs some tens of
// adjustments' normal equations: under a second. Pure. The photos that are already taken stand in
// `flight.taken_m`; with those alone it tells what would be known if the drone landed now.
Result<Summary> plan(const Flight& flight, const Options& options);

}  // namespace plumbline::plan
