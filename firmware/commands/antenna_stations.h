// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/base/result.h"
#include "edge/geodesy/local_frame.h"
#include "edge/survey/survey.h"
#include "firmware/ingest/gnss_log.h"

namespace plumbline::commands {

// Puts the antenna positions of a receiver's log in place of the photos' own, all of them. Where
// no position is a fixed RTK one, most of the error is common to the flight, as it is for the
// photos' own positions (ingest/station_sigmas). `frame` is made at the first position where there
// is none yet.
Status place_antennas(const ingest::AntennaPositions& antenna,
                      std::optional<geodesy::LocalFrame>& frame, survey::Input& survey);

}  // namespace plumbline::commands
