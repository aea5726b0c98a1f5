// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "edge/base/result.h"

namespace plumbline::ingest {

// SHA-256 in 64 lower-case hexadecimal digits.
std::string sha256_hex(std::span<const std::uint8_t> bytes);
Result<std::string> sha256_of_file(const std::filesystem::path& path);

}  // namespace plumbline::ingest
