// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/storage.h"
#include "sim/random.h"

namespace plumbline::sim {

// What goes wrong with one operation. Operations are the calls that change something or sync,
// counted from 0 in the order in which they come.
enum class DiskFault {
  kFails,     // with an input/output error and no effect; a sync loses what it should have saved
  kPowerCut,  // stops half way (an append: after a part of its bytes); nothing works after it
};

// A disk in memory, with a plug to pull. It promises no more than a file system must: bytes are
// kept once their file is synced, names once their folder is (a rename is one change of a folder,
// done or not), in no order otherwise. The idea is that of SQLite's and LevelDB's crash tests.
class SimDisk : public Storage {
 public:
  explicit SimDisk(std::uint64_t capacity_bytes = std::numeric_limits<std::int64_t>::max());

  Result<std::unique_ptr<WritableFile>> create(const std::string& path) override;
  Result<std::unique_ptr<WritableFile>> append_to(const std::string& path) override;
  Result<std::string> read(const std::string& path) override;
  Status truncate(const std::string& path, std::uint64_t length) override;
  Status rename(const std::string& from, const std::string& to) override;
  Status remove(const std::string& path) override;
  Status make_folder(const std::string& path) override;
  Status sync_folder(const std::string& path) override;
  Result<std::vector<std::string>> list(const std::string& folder) override;
  Result<std::uint64_t> free_bytes() override;

  void fail(std::uint64_t operation, DiskFault fault);
  void set_capacity(std::uint64_t bytes);
  // Somebody takes a folder away, with all that is in it, and brings that to the disk.
  void take_away(const std::string& folder);

  // From now on each sync, of a file or a folder, takes so long: before it takes effect, `wait`
  // lets the time pass (a thread sleeps, a virtual clock runs on) on the caller's thread. Meanwhile
  // others may use the disk, and a power cut finds nothing of it saved.
  using Wait = std::function<void(std::chrono::nanoseconds)>;
  void slow_down(std::chrono::nanoseconds each_sync, Wait wait);

  std::uint64_t operations() const;
  std::uint64_t used_bytes() const;  // in all files

  // The disk as it comes back when power was cut now. Of what was not synced each sector of 512
  // bytes is kept or not, or torn within; each name made, changed or removed is kept or not.
  // Files that are open stay with the disk that was.
  std::unique_ptr<SimDisk> after_power_cut(Random& random) const;

 private:
  friend class SimFile;

  struct Content {
    std::string now;
    std::string durable;
  };
  using ContentPointer = std::shared_ptr<Content>;
  struct Entry {          // of a folder
    ContentPointer file;  // empty: a folder
  };
  using Names = std::map<std::string, Entry>;  // by whole path
  // One change of a folder that is not synced: names that appear with what, or disappear.
  struct Change {
    std::string folder;
    std::vector<std::pair<std::string, std::optional<Entry>>> names;
  };

  Status begin(const std::string& attempted, const std::string& path);
  void let_time_pass();
  Result<std::unique_ptr<WritableFile>> open(const std::string& path, bool must_be_new);
  ContentPointer file_at(const std::string& path) const;
  bool has_folder(const std::string& path) const;
  void change(const std::string& folder,
              std::vector<std::pair<std::string, std::optional<Entry>>> names);
  std::uint64_t used_locked() const;
  Status append(Content& content, const std::string& path, std::string_view bytes);
  Status sync(Content& content, const std::string& path);

  mutable std::mutex mutex_;
  std::uint64_t capacity_;
  std::uint64_t operations_ = 0;
  std::map<std::uint64_t, DiskFault> faults_;
  bool off_ = false;
  std::chrono::nanoseconds each_sync_{};
  Wait wait_;
  Names names_;
  Names durable_names_;
  std::vector<Change> changes_;
};

}  // namespace plumbline::sim
