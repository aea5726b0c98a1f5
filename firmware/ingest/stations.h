// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/geodesy/geoid.h"
#include "edge/geodesy/local_frame.h"
#include "edge/orient/problem.h"
#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

struct StationOptions {
  // --photo-heights: empty = by what the photos say; "ellipsoidal"; anything else ("egm96", a
  // name) = above the geoid of `geoid`.
  std::string photo_heights;
  const geodesy::Geoid* geoid = nullptr;    // --geoid; not owned
  std::optional<geodesy::Geodetic> origin;  // of the local frame; empty = chosen from the photos
};

struct Stations {
  std::vector<orient::Photo> photos;         // one per record, in its order
  std::optional<geodesy::LocalFrame> frame;  // empty: no photo has a position
  orient::GnssErrorModel gnss;
  bool absolute_height_known = false;  // false: the height system of the photos is only assumed
  std::vector<std::string> warnings;   // sentences
};

// What the photos' own tags say of where each was taken, with the sigma that they state or that is
// usual for such a fix (stations.cpp has the figures and their sources). Fails where the heights
// are said to be above a geoid and there is none.
Result<Stations> stations_of(const std::vector<PhotoRecord>& photos, const StationOptions& options);

}  // namespace plumbline::ingest
