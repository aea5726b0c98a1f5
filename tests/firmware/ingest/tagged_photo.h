// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plumbline::ingest {

// A small JPEG photo (grey noise of `seed`) with these EXIF and XMP entries, written by Exiv2.
struct PhotoContent {
  int width_px = 64;
  int height_px = 48;
  unsigned seed = 1;
  std::map<std::string, std::string> exif;  // "Exif.Photo.FocalLength" -> "45/10"
  std::map<std::string, std::string> xmp;   // "Xmp.drone-dji.RtkFlag" -> "50"
};
std::vector<std::uint8_t> tagged_photo(const PhotoContent& content);

// 35 deg 21' 40.5" N, 139 deg 7' 52.25" E, 123.45 m.
std::map<std::string, std::string> exif_position();

}  // namespace plumbline::ingest
