// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/orient/solution.h"
#include "edge/plan/ground.h"

namespace plumbline::plan {

// Root mean square sigmas of ground points, metres; empty: not observable, or not seen.
struct Sigma {
  std::optional<double> plan_m;  // of each horizontal axis
  std::optional<double> height_m;
};

// Of one point that is measured as a tie is, to sigma_px in each photo that sees it.
struct GroundSigma {
  // About a best-fit frame (position, azimuth, tilt and scale of the whole removed): of the ground
  // within the radius, for ring and foot; of all ties, for the field.
  Sigma local;
  // In the frame of the positions; empty without RTK.
  Sigma absolute;
};

struct RingSigma {
  Ring ring;
  GroundSigma sigma;
  double seen = 0;  // share of its points that two photos see
  // Height by the formula of one line for the climb (geometry/standard_accuracy.h), local.
  std::optional<double> climb_formula_height_m;
};

struct Prediction {
  int photos = 0;
  bool georeferenced = false;  // there are positions: `absolute` is what counts
  std::vector<RingSigma> rings;
  GroundSigma field;  // over all ground where ties lie
  GroundSigma foot;   // of the very foot of the climb
  std::optional<double> azimuth_deg;
  std::optional<double> tilt_deg;
  std::optional<double> scale;  // relative
  std::optional<double> position_m;
  double focal_length_px = 0;
  double flying_height_m = 0;
  std::vector<orient::Unobservable> unobservable;
};

// The sigmas that an adjustment of this flight would state, from the normal equations of
// edge/orient at the true values: a Cramer-Rao bound. Pure. Fails with a sentence where the flight
// determines nothing.
Result<Prediction> predict(const Flight& flight, const Options& options, Detail detail);

// The figures that a goal is held against: of the worst ring within the radius, absolute where
// georeferenced, else local. Empty where a ring has none.
Sigma worst_ring(const Prediction& prediction);

}  // namespace plumbline::plan
