// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient::testing {

// Many flights with one lie in each, beside the same flights without it.
struct LieTrials {
  int trials = 200;
  std::uint64_t first_seed = 1;
  int threads = 1;  // trials at a time; the tally is the same with any number
};

struct LieTally {
  int flights = 0;
  int failed = 0;        // no solution
  int false_alarms = 0;  // of the clean flights: something was said to be wrong
  int detectable = 0;    // lies larger than the smallest detectable error
  int named = 0;         // of those: exactly what was wrong was named, and nothing else of its kind
  int found = 0;         // of those: named, perhaps with something else of its kind
  int unseen = 0;        // of those: nothing was named
  int below = 0;         // lies smaller than that
  int unchecked = 0;     // clean flights that name an unchecked quantity
  double clean_nees = 0;  // of all targets, over degrees of freedom: 1 where error bars are honest
  // The same where the lie was named, of flights that still know their azimuth to 1 degree: a
  // larger turn moves points by more than its first order.
  int compared = 0;
  double lied_nees = 0;
};

// An antenna moved by `size_m` in a random direction at `wrong` random photos.
LieTally false_stations(const FlightPlan& plan, double size_m, int wrong, const LieTrials& trials);

// Five taped lengths of 2 mm beside the stations (or without them), one of them wrong by `size_m`.
LieTally wrong_length(const FlightPlan& plan, double size_m, const LieTrials& trials);

// Six control points of 5 mm, one of them wrong by `size_m` in a random direction.
LieTally wrong_control(const FlightPlan& plan, double size_m, const LieTrials& trials);

// Six control points of 5 mm, the coordinates of two exchanged.
LieTally exchanged_control(const FlightPlan& plan, const LieTrials& trials);

// Two points bear each other's names in one photo.
LieTally exchanged_rays(const FlightPlan& plan, const LieTrials& trials);

// The calibrated focal length is off by `share`, its stated sigma 0.5 px.
LieTally wrong_focal_length(const FlightPlan& plan, double share, const LieTrials& trials);

std::string in_words(const LieTally& tally);

}  // namespace plumbline::orient::testing
