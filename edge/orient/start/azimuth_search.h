// SPDX-License-Identifier: MIT
#pragma once

#include "edge/orient/network/minimise.h"
#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::orient {

// A descent, and the aligned network that it set out from.
struct Descent {
  State start;
  Minimum end;
};

// Lays a free network onto what is known and descends. From a crude network of few photos the side
// of the circle that looks best need not be the right one, nor the tilts that the images alone
// gave. Of three photos or fewer, or where the cost is in doubt, the descent is repeated from
// photos that look straight down; where it still is, from azimuths all around, and where a third of
// the rays are off, from both. The lowest wins. Of many points a part is tried first, and all only
// where that leads lower.
Descent descend_around_circle(const Network& network, const State& free, const TermOptions& terms,
                              const MinimiseOptions& options);

}  // namespace plumbline::orient
