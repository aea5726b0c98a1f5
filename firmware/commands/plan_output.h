// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/plan/plan.h"

namespace plumbline::commands {

// The plan as a table for people.
std::string plan_table(const plan::Summary& summary, const plan::Flight& flight,
                       const plan::Options& options);

// One JSON object on one line; null where a quantity is not observable or not asked for.
//   sigmas_are "absolute" (there is RTK) or "local": what sigma_plan_m and sigma_height_m are, and
//   what goal_m is held against; rings [{from_m, to_m, sigma_plan_m, sigma_height_m, and both with
//   _local_m and _absolute_m, climb_formula_height_m, seen}], foot, azimuth_deg, tilt_deg,
//   focal_length_px, focal_length, scale, position_m, unobservable [names],
//   unobservable_explained {name: sentence}, standard_accuracy (eq. 6), goal_m, goal_reached,
//   advice [{change, options, cost_s, sigma_plan_m, sigma_height_m, azimuth_deg, unobservable,
//   reaches_goal}], cheapest and best (one of advice), sentence, and what was assumed.
std::string plan_json(const plan::Summary& summary, const plan::Flight& flight,
                      const plan::Options& options);

}  // namespace plumbline::commands
