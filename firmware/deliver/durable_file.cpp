// SPDX-License-Identifier: MIT
#include "firmware/deliver/durable_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <system_error>

namespace plumbline::deliver {
namespace {

// Beyond RLIMIT_FSIZE the kernel sends SIGXFSZ, which kills; held back, write() says EFBIG.
class SizeSignalHeldBack {
 public:
  SizeSignalHeldBack() {
    sigemptyset(&size_signal_);
    sigaddset(&size_signal_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &size_signal_, &before_);
  }
  ~SizeSignalHeldBack() {
    const timespec at_once{};
    while (sigtimedwait(&size_signal_, nullptr, &at_once) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SizeSignalHeldBack(const SizeSignalHeldBack&) = delete;
  SizeSignalHeldBack& operator=(const SizeSignalHeldBack&) = delete;

 private:
  sigset_t size_signal_{};
  sigset_t before_{};
};

int write_whole(int file, const std::string& content) {
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    written += static_cast<std::size_t>(count);
  }
  return 0;
}

int sync_and_close(int file) {
  const int synced = ::fsync(file) == 0 ? 0 : errno;
  const int closed = ::close(file) == 0 ? 0 : errno;
  return synced != 0 ? synced : closed;
}

}  // namespace

int write_durably(const std::filesystem::path& path, const std::string& content) {
  const SizeSignalHeldBack held_back;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  const int failed = write_whole(file, content);
  const int closed = sync_and_close(file);
  return failed != 0 ? failed : closed;
}

int sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return errno;
  const int failed = sync_and_close(file);
  return failed == EINVAL ? 0 : failed;  // some file systems cannot sync a folder
}

std::string why_not_written(const std::filesystem::path& folder, int code) {
  const std::string where = "'" + folder.string() + "'";
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "The disk is full: no results were written to " + where +
             "; free some space or choose another folder with --out.";
    case EFBIG:
      return "The system's limit on the size of files (ulimit -f) is too small: no results were "
             "written to " +
             where + "; raise it.";
    case EACCES:
    case EPERM:
    case EROFS:
      return "The folder " + where +
             " is not writable: no results were written; choose another with --out.";
    case ENOTDIR:
    case EEXIST:
      return "A file is in the way of the folder " + where +
             ": no results were written; choose another with --out.";
    default:
      return "No results were written to " + where + ": " + std::generic_category().message(code) +
             "; choose another folder with --out.";
  }
}

}  // namespace plumbline::deliver
