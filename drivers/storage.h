// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "edge/base/result.h"

namespace plumbline {

// A file being written, at its end only. Closed by the destructor, without sync.
class WritableFile {
 public:
  virtual ~WritableFile() = default;

  // All of `bytes` or an error; after an error the file may hold a part of them.
  virtual Status append(std::string_view bytes) = 0;

  // When it returns well, everything appended so far survives a power cut. After a failed sync
  // nothing is known of what was appended since the last good one, and a second sync proves
  // nothing (Linux drops the dirty pages): write the data anew, elsewhere.
  virtual Status sync() = 0;
};

// SEAM: a disk, as much of it as durability needs to be thought about. Paths are relative to the
// storage's root, with '/', without "..". Any thread may call; one thread per file. Names, like
// bytes, survive a power cut only when synced: a file created or renamed is lost with its name
// until sync_folder() of its folder. What is not synced may survive whole, in part, in any order,
// or torn within a sector.
//
// Every error is one sentence that names the file, what failed, and what to do (disk full, read
// only, no right, gone). A full disk fails append(), leaves what is there readable, and recovers
// when space is made.
class Storage {
 public:
  virtual ~Storage() = default;

  virtual Result<std::unique_ptr<WritableFile>> create(const std::string& path) = 0;  // must be new
  virtual Result<std::unique_ptr<WritableFile>> append_to(const std::string& path) = 0;
  virtual Result<std::string> read(const std::string& path) = 0;
  virtual Status truncate(const std::string& path, std::uint64_t length) = 0;
  virtual Status rename(const std::string& from, const std::string& to) = 0;  // replaces `to`
  virtual Status remove(const std::string& path) = 0;                         // one file
  virtual Status make_folder(const std::string& path) = 0;  // and its parents; may be there
  virtual Status sync_folder(const std::string& path) = 0;  // "" is the root
  virtual Result<std::vector<std::string>> list(const std::string& folder) = 0;  // sorted names
  virtual Result<std::uint64_t> free_bytes() = 0;
};

// Publishes a whole file: temporary name beside it, sync, rename, sync of the folder. After a power
// cut at any moment `path` is as it was before, or whole and new; when it has returned well, new.
// A left-over temporary file ends in ".part" and may be removed.
Status publish(Storage& storage, const std::string& path, std::string_view bytes);

}  // namespace plumbline
