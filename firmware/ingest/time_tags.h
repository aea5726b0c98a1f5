// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "firmware/ingest/photo_tags.h"

namespace plumbline::ingest {

// The values of a tag's text, "30/1 10/1 16404/1000" or "4.5"; empty where one of them is no number
// or not finite.
std::vector<double> tag_numbers(std::string_view text);
// Where there is exactly one.
std::optional<double> tag_number(std::string_view text);

// DateTimeOriginal, SubSecTimeOriginal, OffsetTimeOriginal, GPSDateStamp and GPSTimeStamp.
PhotoTime time_of(const Tags& tags);

}  // namespace plumbline::ingest
