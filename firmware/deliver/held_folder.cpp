// SPDX-License-Identifier: MIT
#include "firmware/deliver/held_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <system_error>
#include <vector>

namespace plumbline::deliver {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "XXXXXX";
constexpr std::time_t kAlive_s = 60;  // made, perhaps, and not yet held

// Its descriptor, or -1 where another process holds it, or it cannot be held.
int hold(const fs::path& folder) {
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0) return -1;
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  ::close(lock);
  return -1;
}

bool is_old(int folder) {
  struct stat status {};
  return ::fstat(folder, &status) == 0 && std::time(nullptr) - status.st_mtime > kAlive_s;
}

void clear_left_over(const fs::path& parent, const std::string& beginning) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename();
    const bool is_ours = name.size() == beginning.size() + kRandom.size();
    if (is_ours && name.starts_with(beginning)) found.push_back(entry->path());
  }
  for (const fs::path& folder : found) {
    const int lock = hold(folder);
    if (lock < 0) continue;
    if (is_old(lock)) fs::remove_all(folder, ignored);
    ::close(lock);
  }
}

}  // namespace

HeldFolder::~HeldFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

int HeldFolder::make_in(const fs::path& parent, const std::string& beginning) {
  clear_left_over(parent, beginning);
  std::string name = (parent / (beginning + std::string(kRandom))).string();
  if (::mkdtemp(name.data()) == nullptr) return errno;
  path_ = name;
  lock_ = hold(path_);  // on file systems without locks it is used all the same
  return 0;
}

}  // namespace plumbline::deliver
