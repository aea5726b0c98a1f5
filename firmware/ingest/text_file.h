// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "edge/base/result.h"

namespace plumbline::ingest {

// Larger than any table a user hands in; more is taken for a mistake.
inline constexpr std::size_t kMaxTextBytes = 256u << 20;

// The whole file. Fails with a sentence where it is missing, a folder, unreadable, or larger than
// `max_bytes`.
Result<std::string> read_text_file(const std::filesystem::path& path,
                                   std::size_t max_bytes = kMaxTextBytes);
Result<std::vector<std::uint8_t>> read_bytes(const std::filesystem::path& path,
                                             std::size_t max_bytes);

// 'text', for sentences.
std::string in_quotes(std::string_view text);

// "name:line: " in front of a sentence about a line of a file.
std::string at_line(const std::string& name, std::size_t line);

}  // namespace plumbline::ingest
