// SPDX-License-Identifier: MIT
#include "firmware/ingest/photo_names.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace plumbline::ingest {
namespace {

std::string without_folder(const std::string& name) {
  return name.substr(name.find_last_of("/\\") + 1);
}

// Only the endings of pictures are dropped: "climb_72.5" is a whole name.
std::string stem_of(const std::string& name) {
  const std::string file = without_folder(name);
  const std::size_t point = file.find_last_of('.');
  if (point == std::string::npos) return file;
  std::string ending;
  for (const char c : file.substr(point + 1)) {
    ending += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  constexpr std::array kEndings = {"jpg", "jpeg", "jpe", "tif", "tiff", "png", "dng", "raw"};
  return std::ranges::count(kEndings, ending) > 0 ? file.substr(0, point) : file;
}

}  // namespace

PhotoNames::PhotoNames(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int index = static_cast<int>(i);
    exact_.emplace(names[i], index);
    const auto [entry, added] = by_stem_.emplace(stem_of(names[i]), index);
    if (!added) entry->second = -1;
  }
}

std::optional<int> PhotoNames::index_of(const std::string& written) const {
  for (const std::string& name : {written, without_folder(written)}) {
    if (const auto found = exact_.find(name); found != exact_.end()) return found->second;
  }
  const auto found = by_stem_.find(stem_of(written));
  if (found == by_stem_.end() || found->second < 0) return std::nullopt;
  return found->second;
}

}  // namespace plumbline::ingest
