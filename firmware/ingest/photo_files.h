// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"

namespace plumbline::ingest {

struct PhotoFile {
  std::filesystem::path path;
  std::string name;  // file name; with its folder in front where two have the same
};

struct PhotoFiles {
  std::vector<PhotoFile> files;  // sorted by name, then path
  std::optional<std::filesystem::path> camera_toml;
  std::vector<std::string> warnings;
};

// The JPEG files (by extension) among `paths`; see read_photos().
Result<PhotoFiles> find_photo_files(const std::vector<std::filesystem::path>& paths);

// Order of names in which runs of digits count by their value: IMG_9 before IMG_10.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace plumbline::ingest
