// SPDX-License-Identifier: MIT
#pragma once

#include "edge/geodesy/local_frame.h"
#include "sim/gnss_stream.h"
#include "sim/sim_camera.h"
#include "sim/sim_trigger_line.h"

// What a day is made of: typed in.
namespace plumbline::soak {

// Rises for half a minute to 90 m above its foot and comes down again, without end.
geodesy::Geodetic place_at(double seconds);

// Where the photos are wanted: half way up.
inline constexpr double kWantedHeight_m = 135;

// In the first ten seconds of the way down of some minute of each hour nothing, no position,
// garbage, float and flipped digits come.
sim::GnssStreamOptions stream_options(int hours);

sim::SimCameraOptions camera_options();
sim::TriggerLineFaults line_faults();

}  // namespace plumbline::soak
