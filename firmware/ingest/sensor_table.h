// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace plumbline::ingest {

// The longer side of the sensor area that a whole photo comes from, mm, by EXIF make and model;
// empty for a camera that is not in the table.
std::optional<double> sensor_long_side_mm(const std::string& make, const std::string& model);

}  // namespace plumbline::ingest
