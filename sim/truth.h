// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/geodesy/local_frame.h"
#include "sim/flight.h"
#include "sim/world.h"

namespace plumbline::sim {

// The texts of truth/, in the formats of the files that `plumbline measure` and `orient` read.
// `frame` is the local frame of the world.

// photo, true centre (ENU and geodetic) and attitude of the camera.
std::string photos_csv(const Flight& flight, const geodesy::LocalFrame& frame);

// The targets as measured by hand: true pixels plus noise, in every photo that sees a whole plate.
std::string picks_csv(const World& world, const Flight& flight);

// True coordinates of the targets (ENU and geodetic), 1 mm sigma.
std::string check_csv(const World& world, const geodesy::LocalFrame& frame);

// The ground as an Esri ASCII grid in ENU, cells of 0.5 m, heights at their centres.
std::string surface_asc(const World& world, double half_extent_m);

}  // namespace plumbline::sim
