// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

// EXIF and XMP entries as text, by Exiv2's names ("Exif.Photo.FocalLength" -> "45/10",
// "Xmp.drone-dji.RtkFlag" -> "50"). Rationals are "n/d", several values are separated by blanks.
using Tags = std::map<std::string, std::string, std::less<>>;

// The tags of a JPEG; none where it holds none. A warning where they are there and damaged.
// Never fails: a photo without tags is still a photo. Reentrant.
Tags read_tags(std::span<const std::uint8_t> jpeg, const std::string& name,
               std::vector<std::string>& warnings);

// Fills what the tags say into `record` (which has its name and size). What cannot be (a latitude
// of 91 degrees, the island 0 N 0 E) is left out with a warning.
void interpret(const Tags& tags, PhotoRecord& record, std::vector<std::string>& warnings);

}  // namespace plumbline::ingest
