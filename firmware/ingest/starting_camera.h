// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/geometry/camera.h"
#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

struct StartingCamera {
  geometry::Camera camera;            // nominal values with wide prior sigmas
  std::string source;                 // a sentence: where the focal length is from, and its sigma
  std::vector<std::string> warnings;  // sentences
};

// A camera to start from where there is no camera.toml: focal length by EXIF and the sensor's width
// (table of known cameras, sigma 3 %), else the focal plane resolution (3 %), else the 35 mm
// equivalent (5 %), else a guess (30 %). Fails where the photos are of different cameras. `photos`
// is not empty and of one size.
Result<StartingCamera> starting_camera(const std::vector<PhotoRecord>& photos);

}  // namespace plumbline::ingest
