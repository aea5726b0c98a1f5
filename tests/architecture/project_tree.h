// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/architecture/source_text.h"

namespace plumbline::architecture {

// The C++ files of edge, drivers, sim, firmware and tests under `root`, in the order of their
// paths.
std::vector<SourceFile> source_files(const std::filesystem::path& root);

// The text files that make the project: sources, CMake, scripts, documents; nothing of build/.
std::vector<SourceFile> text_files(const std::filesystem::path& root);

struct FileSize {
  std::string path;
  std::uintmax_t bytes = 0;
};

// The files under version control that exist; empty where `root` is not a git checkout.
std::optional<std::vector<FileSize>> versioned_files(const std::filesystem::path& root);

}  // namespace plumbline::architecture
