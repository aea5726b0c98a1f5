// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "edge/base/result.h"
#include "edge/geodesy/geoid.h"

namespace plumbline::ingest {

// --geoid FILE: .pgm as GeographicLib has them, or ISG text.
Result<geodesy::Geoid> read_geoid(const std::filesystem::path& path);

}  // namespace plumbline::ingest
