// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/base/exposure_timing.h"
#include "edge/timing/antenna_predictor.h"

namespace plumbline::timing {

// Where the antenna was in the middle of the exposure of a row (counted from the top, halves
// allowed; of a photo as a whole: the middle one). What the exposure's own time leaves open, its
// sigma times the velocity, is in the covariance, too; that of the receiver's least latency is
// apart, as in AntennaPredictor::at(). Empty where that is.
std::optional<PredictedAntenna> place_of_exposure(const AntennaPredictor& antenna,
                                                  const ExposureTiming& exposure, double row,
                                                  const GnssClock& clock);

}  // namespace plumbline::timing
