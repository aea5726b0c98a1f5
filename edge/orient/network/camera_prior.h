// SPDX-License-Identifier: MIT
#pragma once

#include "edge/geometry/camera.h"

namespace plumbline::orient {

// The inverse covariance of what is known of the interior before the adjustment. A parameter held
// fixed has zero rows. A free one gets the widest spread that lenses of survey cameras show (f
// 20 %, principal point 5 % of the width, ...): ten parameters are never free all at once, since
// a climb without tilt cannot tell f from height.
geometry::InteriorMatrix prior_information(const geometry::Camera& camera);

// An extra spring to the start for the first, crude stage.
geometry::InteriorMatrix bridle_information(const geometry::Camera& camera);

// Prior standard deviations as used (0 = held fixed).
geometry::InteriorVector prior_sigmas(const geometry::Camera& camera);

}  // namespace plumbline::orient
