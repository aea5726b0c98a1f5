// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "edge/base/result.h"
#include "edge/geodesy/geoid.h"
#include "edge/geodesy/local_frame.h"
#include "firmware/deliver/product.h"

namespace plumbline::commands {

// The geoid of --geoid FILE; empty where `path` is.
Result<std::optional<geodesy::Geoid>> read_geoid(const std::filesystem::path& path);

std::optional<deliver::GeoOrigin> geo_origin(const std::optional<geodesy::LocalFrame>& frame);

// The name of what was measured: the last part of its path.
std::string title_of(const std::filesystem::path& path);

}  // namespace plumbline::commands
