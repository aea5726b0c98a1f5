// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "drivers/storage.h"

namespace plumbline::posix {

// A folder of the file system. Fails where it is not there or cannot be entered. Paths are resolved
// from the folder as it was opened, wherever it is moved to.
Result<std::unique_ptr<Storage>> open_storage(const std::string& folder);

// What is to be said of the kind of file system that `folder` lies on: FAT and exFAT, as memory
// cards come, lose files and folders of their own when power is cut. Empty for others.
std::optional<std::string> file_system_warning(const std::string& folder);

}  // namespace plumbline::posix
