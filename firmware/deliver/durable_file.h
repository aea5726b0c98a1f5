// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace plumbline::deliver {

// Each returns 0 or the errno of the call that failed.

// A new file with `content`, on the disk (fsync) when this returns. A limit on the size of files
// (RLIMIT_FSIZE) is reported as EFBIG and does not kill the process.
int write_durably(const std::filesystem::path& path, const std::string& content);

// Brings the names in a folder to the disk.
int sync_folder(const std::filesystem::path& folder);

// What errno `code` means for a user who wanted to write to `folder`: one sentence.
std::string why_not_written(const std::filesystem::path& folder, int code);

}  // namespace plumbline::deliver
