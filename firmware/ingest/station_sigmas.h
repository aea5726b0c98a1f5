// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "edge/orient/problem.h"
#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

// How good the positions of a flight's photos are: by what they state, else by what is usual for
// their kind of fix.
struct StationSigmas {
  std::vector<Eigen::Vector3d> white_m;  // east, north, up of each position
  orient::GnssErrorModel common;
  std::vector<std::string> warnings;  // sentences
};

// `times_known`: the photos' times are known, so that slow drift can be told from white noise;
// otherwise drift is counted as white.
StationSigmas station_sigmas(const std::vector<const PhotoPosition*>& positions, bool times_known);

}  // namespace plumbline::ingest
