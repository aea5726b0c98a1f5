// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "edge/base/result.h"

namespace plumbline::deliver {

struct NamedFile {
  std::string name;  // no folder
  std::string content;
};

// Writes all `files` into `folder`, or none. They are written to a hidden folder on the same file
// system and brought to the disk (fsync) before the first is renamed into place. A new `folder`
// appears whole, by one rename; what a process that was killed left of its hidden folder is cleared
// away. In one that exists, files of these names are replaced, those named
// in `obsolete` removed, all others left alone; where a rename fails, the old ones are put back.
//
// Fails with one sentence (disk full, not writable, a file in the way); then the folder, and the
// folders above it, are as they were.
Status write_all_or_nothing(const std::filesystem::path& folder,
                            const std::vector<NamedFile>& files,
                            const std::vector<std::string>& obsolete);

}  // namespace plumbline::deliver
