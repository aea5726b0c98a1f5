// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "edge/base/result.h"

namespace plumbline::posix {

// "Cannot write photos/0003.jpg: the disk is full; make space on it." for what was attempted, the
// file's path as the user knows it, and errno.
Error storage_error(const std::string& attempted, const std::string& path, int code);

// As file_system_warning(folder) in posix_storage.h, of a type as statfs(2) numbers it.
std::optional<std::string> file_system_warning(const std::string& folder, long type);

}  // namespace plumbline::posix
