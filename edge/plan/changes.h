// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/plan/flight.h"
#include "edge/plan/options.h"

namespace plumbline::plan {

// Something more that could be done: photos beside those of the flight, or something known.
struct Change {
  std::string what;     // in words: "one more photo 10 m aside, at 90 m"
  std::string options;  // of `plumbline plan`, to try it: "--side-step 10"
  double cost_s = 0;    // by Options::costs
  std::vector<Eigen::Vector3d> photos_m;
  // What of it there is to do; two changes together have two of these.
  double aside_m = 0;             // 0: not a side-step
  bool across = false;            // and as far at a right angle: an L
  std::optional<double> climb_m;  // to this height, for a longer climb
  std::optional<double> from_m;   // photos from this height on, for one that begins lower
  std::optional<double> step_m;   // instead of the usual one
  std::optional<double> heading_sigma_deg;
  std::optional<double> known_length_m;
  int control_points = 0;
};

// One change at a time: side-steps of 2, 5, 10 and 20 m, an L of the same, a climb longer up or
// down, photos in between, a compass of 2 or 1 degrees, a known length, a control point. Those
// that the flight has already, or that would leave the permitted heights, are not among them.
// Sorted by cost.
std::vector<Change> single_changes(const Flight& flight, const Options& options);

// Two of them together: what goes aside by 10 m or more with what climbs longer or takes more
// photos. Sorted by cost.
std::vector<Change> paired_changes(const std::vector<Change>& singles);

Flight changed(const Flight& flight, const Change& change);
Options changed(const Options& options, const Change& change);

// Seconds from the first photo to the last, with a stop at each, and straight down again.
double duration_s(const Flight& flight, const Costs& costs);

}  // namespace plumbline::plan
