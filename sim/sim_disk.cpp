// SPDX-License-Identifier: MIT
#include "sim/sim_disk.h"

#include <algorithm>
#include <utility>

namespace plumbline::sim {
namespace {

constexpr std::size_t kSector = 512;

std::string parent_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

Error fault(const std::string& attempted, const std::string& path, const std::string& why) {
  return {"Cannot " + attempted + " '" + path + "': " + why + "."};
}

char byte_at(const std::string& bytes, std::size_t index) {
  return index < bytes.size() ? bytes[index] : '\0';
}

// Sectors of `now` or of `durable`, by chance, up to a length by chance; one of them torn.
std::string survivor(const std::string& durable, const std::string& now, Random& random) {
  if (durable == now) return now;
  const std::size_t least = std::min(durable.size(), now.size());
  const std::size_t most = std::max(durable.size(), now.size());
  const double choice = random.uniform();
  const double share = choice < 0.3 ? 0 : choice < 0.6 ? 1 : random.uniform();
  const std::size_t size =
      least + static_cast<std::size_t>(share * static_cast<double>(most - least));
  const double kept = random.uniform();
  std::string out(size, '\0');
  for (std::size_t begin = 0; begin < size; begin += kSector) {
    const std::size_t end = std::min(begin + kSector, size);
    const bool torn = random.uniform() < 0.1;
    const std::size_t from_now = torn                      ? begin + random.next() % kSector
                                 : random.uniform() < kept ? end
                                                           : begin;
    for (std::size_t i = begin; i < end; ++i)
      out[i] = byte_at(i < from_now && i < now.size() ? now : durable, i);
  }
  return out;
}

// Of a file that was shortened.
void give_back_memory(std::string& content) {
  if (content.capacity() > 4 * content.size()) content.shrink_to_fit();
}

}  // namespace

// A file of the disk, which outlives it.
class SimFile : public WritableFile {
 public:
  SimFile(SimDisk& disk, std::shared_ptr<SimDisk::Content> content, std::string path)
      : disk_(disk), content_(std::move(content)), path_(std::move(path)) {}

  Status append(std::string_view bytes) override { return disk_.append(*content_, path_, bytes); }
  Status sync() override { return disk_.sync(*content_, path_); }

 private:
  SimDisk& disk_;
  std::shared_ptr<SimDisk::Content> content_;
  std::string path_;
};

SimDisk::SimDisk(std::uint64_t capacity_bytes) : capacity_(capacity_bytes) {}

Result<std::unique_ptr<WritableFile>> SimDisk::create(const std::string& path) {
  return open(path, true);
}

Result<std::unique_ptr<WritableFile>> SimDisk::append_to(const std::string& path) {
  return open(path, false);
}

Result<std::unique_ptr<WritableFile>> SimDisk::open(const std::string& path, bool must_be_new) {
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("create", path); !begun) return begun.error();
  if (!has_folder(parent_of(path))) return fault("create", path, "there is no such folder");
  if (has_folder(path)) return fault("create", path, "it is a folder");
  ContentPointer content = file_at(path);
  if (content && must_be_new) return fault("create", path, "it is there already");
  if (!content) {
    content = std::make_shared<Content>();
    change(parent_of(path), {{path, Entry{content}}});
  }
  return std::unique_ptr<WritableFile>(std::make_unique<SimFile>(*this, content, path));
}

Result<std::string> SimDisk::read(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (off_) return fault("read", path, "the power is off");
  const ContentPointer content = file_at(path);
  if (!content) return fault("read", path, "there is no such file or folder");
  return content->now;
}

Status SimDisk::truncate(const std::string& path, std::uint64_t length) {
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("shorten", path); !begun) return begun;
  const ContentPointer content = file_at(path);
  if (!content) return fault("shorten", path, "there is no such file or folder");
  content->now.resize(length);
  give_back_memory(content->now);
  return Done{};
}

Status SimDisk::rename(const std::string& from, const std::string& to) {
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("rename", from); !begun) return begun;
  const ContentPointer content = file_at(from);
  if (!content) return fault("rename", from, "there is no such file or folder");
  if (!has_folder(parent_of(to))) return fault("rename", from, "there is no such folder");
  if (has_folder(to)) return fault("rename", from, "there is a folder of the new name");
  if (from == to) return Done{};
  change(parent_of(to), {{from, std::nullopt}, {to, Entry{content}}});
  return Done{};
}

Status SimDisk::remove(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("remove", path); !begun) return begun;
  if (!file_at(path)) return fault("remove", path, "there is no such file or folder");
  change(parent_of(path), {{path, std::nullopt}});
  return Done{};
}

Status SimDisk::make_folder(const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("make the folder", path); !begun) return begun;
  for (std::size_t slash = 0; slash != std::string::npos;) {
    slash = path.find('/', slash + 1);
    const std::string part = path.substr(0, slash);
    if (file_at(part)) return fault("make the folder", part, "there is a file of that name");
    if (!has_folder(part)) change(parent_of(part), {{part, Entry{}}});
  }
  return Done{};
}

Status SimDisk::sync_folder(const std::string& path) {
  let_time_pass();
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("bring to the disk", path); !begun) return begun;
  if (!has_folder(path)) return fault("bring to the disk", path, "there is no such folder");
  std::erase_if(changes_, [&](const Change& change) {
    if (change.folder != path) return false;
    for (const auto& [name, entry] : change.names) {
      durable_names_.erase(name);
      if (entry) durable_names_.emplace(name, *entry);
    }
    return true;
  });
  return Done{};
}

Result<std::vector<std::string>> SimDisk::list(const std::string& folder) {
  const std::lock_guard lock(mutex_);
  if (off_) return fault("list", folder, "the power is off");
  if (!has_folder(folder)) return fault("list", folder, "there is no such folder");
  std::vector<std::string> names;
  for (const auto& [path, entry] : names_) {
    if (parent_of(path) == folder)
      names.push_back(folder.empty() ? path : path.substr(folder.size() + 1));
  }
  return names;
}

Result<std::uint64_t> SimDisk::free_bytes() {
  const std::lock_guard lock(mutex_);
  if (off_) return fault("ask for the free space of", "", "the power is off");
  const std::uint64_t used = used_locked();
  return used < capacity_ ? capacity_ - used : 0;
}

void SimDisk::fail(std::uint64_t operation, DiskFault fault) {
  const std::lock_guard lock(mutex_);
  faults_[operation] = fault;
}

void SimDisk::set_capacity(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  capacity_ = bytes;
}

void SimDisk::slow_down(std::chrono::nanoseconds each_sync, Wait wait) {
  const std::lock_guard lock(mutex_);
  each_sync_ = each_sync;
  wait_ = std::move(wait);
}

void SimDisk::take_away(const std::string& folder) {
  const std::lock_guard lock(mutex_);
  const std::string inside = folder + '/';
  const auto is_in = [&](const std::string& path) {
    return path == folder || path.starts_with(inside);
  };
  std::erase_if(names_, [&](const auto& name) { return is_in(name.first); });
  std::erase_if(durable_names_, [&](const auto& name) { return is_in(name.first); });
  std::erase_if(changes_, [&](Change& change) {
    std::erase_if(change.names, [&](const auto& name) { return is_in(name.first); });
    return change.names.empty();
  });
}

std::uint64_t SimDisk::operations() const {
  const std::lock_guard lock(mutex_);
  return operations_;
}

std::uint64_t SimDisk::used_bytes() const {
  const std::lock_guard lock(mutex_);
  return used_locked();
}

std::unique_ptr<SimDisk> SimDisk::after_power_cut(Random& random) const {
  const std::lock_guard lock(mutex_);
  auto disk = std::make_unique<SimDisk>(capacity_);
  Names kept = durable_names_;
  for (const Change& change : changes_) {
    if (random.uniform() < 0.5) continue;
    for (const auto& [name, entry] : change.names) {
      kept.erase(name);
      if (entry) kept.emplace(name, *entry);
    }
  }
  std::map<const Content*, ContentPointer> survivors;
  for (const auto& [path, entry] : kept) {
    if (!parent_of(path).empty() && !disk->names_.contains(parent_of(path))) continue;
    Entry copy;
    if (entry.file) {
      ContentPointer& content = survivors[entry.file.get()];
      if (!content) {
        content = std::make_shared<Content>();
        content->now = content->durable = survivor(entry.file->durable, entry.file->now, random);
      }
      copy.file = content;
    }
    disk->names_.emplace(path, copy);
  }
  disk->durable_names_ = disk->names_;
  return disk;
}

// Without the lock, for others go on.
void SimDisk::let_time_pass() {
  std::unique_lock lock(mutex_);
  const Wait wait = wait_;
  const std::chrono::nanoseconds time = each_sync_;
  lock.unlock();
  if (wait && time > std::chrono::nanoseconds(0)) wait(time);
}

// Counts an operation, and fails it where that is its fate.
Status SimDisk::begin(const std::string& attempted, const std::string& path) {
  if (off_) return fault(attempted, path, "the power is off");
  const auto fate = faults_.find(operations_++);
  if (fate == faults_.end()) return Done{};
  if (fate->second == DiskFault::kFails) return fault(attempted, path, "the disk failed");
  off_ = true;
  return fault(attempted, path, "the power went off");
}

SimDisk::ContentPointer SimDisk::file_at(const std::string& path) const {
  const auto entry = names_.find(path);
  return entry == names_.end() ? nullptr : entry->second.file;
}

bool SimDisk::has_folder(const std::string& path) const {
  if (path.empty()) return true;
  const auto entry = names_.find(path);
  return entry != names_.end() && !entry->second.file;
}

void SimDisk::change(const std::string& folder,
                     std::vector<std::pair<std::string, std::optional<Entry>>> names) {
  for (const auto& [name, entry] : names) {
    names_.erase(name);
    if (entry) names_.emplace(name, *entry);
  }
  changes_.push_back({folder, std::move(names)});
}

std::uint64_t SimDisk::used_locked() const {
  std::uint64_t used = 0;
  for (const auto& [path, entry] : names_) used += entry.file ? entry.file->now.size() : 0;
  return used;
}

Status SimDisk::append(Content& content, const std::string& path, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  const bool was_off = off_;
  if (const Status begun = begin("write", path); !begun) {
    if (off_ && !was_off) content.now += bytes.substr(0, bytes.size() / 2);
    return begun;
  }
  const std::uint64_t used = used_locked();
  const std::uint64_t space = used < capacity_ ? capacity_ - used : 0;
  content.now += bytes.substr(0, space);
  if (bytes.size() > space) return fault("write", path, "the disk is full; make space on it");
  return Done{};
}

// Linux marks pages clean that it could not write: what was to be saved is gone, and a second sync
// says that all is well.
Status SimDisk::sync(Content& content, const std::string& path) {
  let_time_pass();
  const std::lock_guard lock(mutex_);
  if (const Status begun = begin("bring to the disk", path); !begun) {
    if (!off_) {
      const std::size_t size = content.now.size();
      content.now = content.durable;
      content.now.resize(size);
    }
    return begun;
  }
  content.durable = content.now;
  give_back_memory(content.durable);
  return Done{};
}

}  // namespace plumbline::sim
