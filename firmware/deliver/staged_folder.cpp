// SPDX-License-Identifier: MIT
#include "firmware/deliver/staged_folder.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "firmware/deliver/durable_file.h"
#include "firmware/deliver/held_folder.h"

namespace plumbline::deliver {
namespace {

namespace fs = std::filesystem;

int rename_to(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

// Folders made on the way, innermost last; taken away again unless kept.
class NewFolders {
 public:
  ~NewFolders() {
    std::error_code ignored;
    for (auto folder = made_.rbegin(); !kept_ && folder != made_.rend(); ++folder)
      fs::remove(*folder, ignored);
  }
  int make_all(const fs::path& folder) {
    std::error_code error;
    if (folder.empty() || fs::is_directory(folder, error)) return 0;
    if (const int failed = make_all(folder.parent_path())) return failed;
    if (::mkdir(folder.c_str(), 0777) != 0) return errno;
    made_.push_back(folder);
    return 0;
  }
  void keep() { kept_ = true; }

 private:
  std::vector<fs::path> made_;
  bool kept_ = false;
};

// A hidden folder that holds the new files in `fresh()`; removed at the end, wherever that comes.
class Stage {
 public:
  int open_in(const fs::path& parent) {
    if (const int failed = folder_.make_in(parent, ".plumbline-")) return failed;
    const bool made = ::mkdir(fresh().c_str(), 0777) == 0 && ::mkdir(old().c_str(), 0777) == 0;
    return made ? 0 : errno;
  }
  int fill(const std::vector<NamedFile>& files) {
    for (const NamedFile& file : files)
      if (const int failed = write_durably(fresh() / file.name, file.content)) return failed;
    return sync_folder(fresh());
  }
  fs::path fresh() const { return folder_.path() / "fresh"; }
  fs::path old() const { return folder_.path() / "old"; }

 private:
  HeldFolder folder_;
};

// Renames with a way back.
class Moves {
 public:
  int move(const fs::path& from, const fs::path& to) {
    const int failed = rename_to(from, to);
    if (failed == 0) done_.emplace_back(from, to);
    return failed;
  }
  int move_if_there(const fs::path& from, const fs::path& to) {
    const int failed = move(from, to);
    return failed == ENOENT ? 0 : failed;
  }
  void undo() {
    for (auto step = done_.rbegin(); step != done_.rend(); ++step)
      rename_to(step->second, step->first);
    done_.clear();
  }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

int exchange(const fs::path& folder, const Stage& stage, const std::vector<NamedFile>& files,
             const std::vector<std::string>& obsolete, Moves& moves) {
  const fs::path old = stage.old();
  for (const std::string& name : obsolete)
    if (const int failed = moves.move_if_there(folder / name, old / name)) return failed;
  for (const NamedFile& file : files) {
    if (const int failed = moves.move_if_there(folder / file.name, old / file.name)) return failed;
    if (const int failed = moves.move(stage.fresh() / file.name, folder / file.name)) return failed;
  }
  return sync_folder(folder);
}

// Staged inside, since the folder may be the root of a disk of its own.
int write_into_existing(const fs::path& folder, const std::vector<NamedFile>& files,
                        const std::vector<std::string>& obsolete) {
  Stage stage;
  if (const int failed = stage.open_in(folder)) return failed;
  if (const int failed = stage.fill(files)) return failed;
  Moves moves;
  const int failed = exchange(folder, stage, files, obsolete, moves);
  if (failed != 0) moves.undo();
  return failed;
}

int write_new(const fs::path& folder, const std::vector<NamedFile>& files) {
  NewFolders above;
  const fs::path parent = folder.parent_path();
  if (const int failed = above.make_all(parent)) return failed;
  Stage stage;
  if (const int failed = stage.open_in(parent)) return failed;
  if (const int failed = stage.fill(files)) return failed;
  if (const int failed = rename_to(stage.fresh(), folder)) return failed;
  above.keep();
  return sync_folder(parent);
}

int write_anywhere(const fs::path& folder, const std::vector<NamedFile>& files,
                   const std::vector<std::string>& obsolete) {
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error).lexically_normal();
  if (error) return error.value();
  const fs::path place = whole.has_filename() ? whole : whole.parent_path();
  const fs::file_status status = fs::status(place, error);
  if (fs::is_directory(status)) return write_into_existing(place, files, obsolete);
  if (fs::exists(status)) return ENOTDIR;
  return write_new(place, files);
}

}  // namespace

Status write_all_or_nothing(const fs::path& folder, const std::vector<NamedFile>& files,
                            const std::vector<std::string>& obsolete) {
  const int failed = write_anywhere(folder, files, obsolete);
  if (failed != 0) return Error{why_not_written(folder, failed)};
  return Done{};
}

}  // namespace plumbline::deliver
