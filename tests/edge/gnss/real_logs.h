// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace plumbline::gnss {

// The folder of real receivers' logs, which are no part of the repository.
inline std::filesystem::path real_logs() {
  const char* shared = std::getenv("PLUMBLINE_SHARED");
  const std::filesystem::path beside =
      std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared";
  return (shared != nullptr ? std::filesystem::path(shared) : beside) / "data" / "nmea";
}

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace plumbline::gnss
