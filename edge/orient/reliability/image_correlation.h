// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/network/network.h"

namespace plumbline::orient {

// Neighbouring points of a photo can share an error that the camera model does not know: a lens
// that stabilises, a rolling shutter, shadows that moved. Then a thousand ties tell less than a
// thousand independent ones would, and error bars that count them as such are too small.
struct ImageCorrelation {
  double intraclass = 0;  // correlation of residuals of one part of one photo
  double design_effect =
      1;  // by which variances are too small; 1 where nothing significant is seen
};

// Of the ties, after a plain adjustment: residuals are compared within cells of 1/8 by 1/6 of each
// photo. design effect = 1 + (mean rays per cell - 1) correlation (L. Kish, Survey Sampling, 1965).
ImageCorrelation image_correlation(const Network& network, const State& state);

}  // namespace plumbline::orient
