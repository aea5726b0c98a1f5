// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::ingest {

// Finds a photo by its name as a table may write it: exactly, else without folder, else without
// extension too (where that names one photo only).
class PhotoNames {
 public:
  explicit PhotoNames(const std::vector<std::string>& names);
  std::optional<int> index_of(const std::string& written) const;

 private:
  std::map<std::string, int, std::less<>> exact_;
  std::map<std::string, int, std::less<>> by_stem_;  // -1: more than one
};

}  // namespace plumbline::ingest
