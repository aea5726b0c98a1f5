// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "drivers/storage.h"

namespace plumbline::flight {

// A journal on the disk. What could not be written stays in memory and is written again, from the
// last byte that is known to be durable on: after a failed sync nobody knows what became of the
// rest. One thread.
class JournalFile {
 public:
  // `path` is a file of `durable` bytes, all synced; it is made where `durable` is 0. `storage`
  // outlives it.
  JournalFile(Storage& storage, std::string path, std::uint64_t durable);

  // Takes the bytes in any case.
  void append(std::string_view bytes);

  // Writes and syncs all that was taken. Fails with a sentence, and may be called again later.
  Status sync();

  // Writes without sync, so that less waits.
  Status flush();

  // Forgets all there is, also on the disk; begins with `head`.
  void start_over(std::string_view head);

  std::uint64_t durable_bytes() const { return durable_; }
  std::size_t waiting_bytes() const { return waiting_.size(); }

 private:
  Status open();
  Status write();
  Status broken(Error error);

  Storage& storage_;
  std::string path_;
  std::uint64_t durable_;
  std::string waiting_;      // after the durable ones
  std::size_t written_ = 0;  // of those, to the open file
  bool in_doubt_ = false;    // the file may end in a part of something
  std::unique_ptr<WritableFile> file_;
};

}  // namespace plumbline::flight
