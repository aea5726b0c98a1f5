// SPDX-License-Identifier: MIT
#include "drivers/posix/posix_storage.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include "drivers/posix/descriptor.h"
#include "drivers/posix/storage_errors.h"

namespace plumbline::posix {
namespace {

constexpr mode_t kFileMode = 0644;
constexpr mode_t kFolderMode = 0755;

// Holds back the signal by which a limit on file sizes would kill the process, on this thread, so
// that write() says EFBIG.
class WithoutFileSizeSignal {
 public:
  WithoutFileSizeSignal() {
    ::sigemptyset(&signal_);
    ::sigaddset(&signal_, SIGXFSZ);
    ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  ~WithoutFileSizeSignal() {
    const timespec at_once{};
    while (::sigtimedwait(&signal_, nullptr, &at_once) == SIGXFSZ) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutFileSizeSignal(const WithoutFileSizeSignal&) = delete;
  WithoutFileSizeSignal& operator=(const WithoutFileSizeSignal&) = delete;

 private:
  sigset_t signal_{}, before_{};
};

// 0, or errno.
int write_all(int fd, std::string_view bytes) {
  const WithoutFileSizeSignal quiet;
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

int read_all(int fd, std::string& out) {
  std::array<char, 65536> chunk;
  while (true) {
    const ssize_t count = ::read(fd, chunk.data(), chunk.size());
    if (count == 0) return 0;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    out.append(chunk.data(), static_cast<std::size_t>(count));
  }
}

// At the end and at a fault readdir() returns the same; only errno tells a list from half of one.
int read_names(DIR* stream, std::vector<std::string>& names) {
  while (true) {
    errno = 0;
    const dirent* entry = ::readdir(stream);
    if (entry == nullptr) return errno;
    const std::string name(entry->d_name);
    if (name != "." && name != "..") names.push_back(name);
  }
}

// fsync is not tried again when it fails: the second would succeed without the lost pages.
int sync_of(int fd) { return ::fsync(fd) == 0 ? 0 : errno; }

class PosixFile : public WritableFile {
 public:
  PosixFile(Descriptor descriptor, std::string path)
      : descriptor_(std::move(descriptor)), path_(std::move(path)) {}

  Status append(std::string_view bytes) override {
    if (const int code = write_all(descriptor_.get(), bytes))
      return storage_error("write", path_, code);
    return Done{};
  }
  Status sync() override {
    if (const int code = sync_of(descriptor_.get()))
      return storage_error("bring to the disk", path_, code);
    return Done{};
  }

 private:
  Descriptor descriptor_;
  std::string path_;
};

// Nothing but plain names, so that nothing outside the root is touched.
bool stays_inside(const std::string& path) {
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view name(path.data() + begin, end - begin);
    if (name.empty() || name == "." || name == "..") return false;
    begin = end + 1;
  }
  return true;
}

class PosixStorage : public Storage {
 public:
  PosixStorage(Descriptor root, std::string name)
      : root_(std::move(root)), name_(std::move(name)) {}

  Result<std::unique_ptr<WritableFile>> create(const std::string& path) override {
    return open_for_writing("create", path, O_CREAT | O_EXCL);
  }
  Result<std::unique_ptr<WritableFile>> append_to(const std::string& path) override {
    return open_for_writing("open", path, O_CREAT);
  }

  Result<std::string> read(const std::string& path) override {
    const auto file = opened("read", path, O_RDONLY);
    if (!file) return file.error();
    std::string bytes;
    if (const int code = read_all(file->get(), bytes)) return fault("read", path, code);
    return bytes;
  }

  Status truncate(const std::string& path, std::uint64_t length) override {
    const auto file = opened("shorten", path, O_WRONLY);
    if (!file) return file.error();
    return done(::ftruncate(file->get(), static_cast<off_t>(length)), "shorten", path);
  }
  Status rename(const std::string& from, const std::string& to) override {
    if (!stays_inside(from) || !stays_inside(to)) return outside(stays_inside(from) ? to : from);
    return done(::renameat(root_.get(), from.c_str(), root_.get(), to.c_str()), "rename", from);
  }
  Status remove(const std::string& path) override {
    if (!stays_inside(path)) return outside(path);
    return done(::unlinkat(root_.get(), path.c_str(), 0), "remove", path);
  }

  Status make_folder(const std::string& path) override {
    if (!stays_inside(path)) return outside(path);
    for (std::size_t slash = 0; slash != std::string::npos;) {
      slash = path.find('/', slash + 1);
      const std::string part = path.substr(0, slash);
      if (::mkdirat(root_.get(), part.c_str(), kFolderMode) != 0 && errno != EEXIST)
        return fault("make the folder", part, errno);
    }
    return opened_folder("make the folder", path).status;
  }

  Status sync_folder(const std::string& path) override {
    const auto folder = opened_folder("bring to the disk", path);
    if (!folder.status) return folder.status;
    const int code = sync_of(folder.descriptor.get());
    if (code == 0 || code == EINVAL) return Done{};  // some file systems cannot sync a folder
    return fault("bring to the disk", path, code);
  }

  Result<std::vector<std::string>> list(const std::string& path) override {
    auto folder = opened_folder("list", path);
    if (!folder.status) return folder.status.error();
    const int fd = ::fcntl(folder.descriptor.get(), F_DUPFD_CLOEXEC, 0);
    DIR* stream = fd < 0 ? nullptr : ::fdopendir(fd);
    if (stream == nullptr) return fault("list", path, errno);
    std::vector<std::string> names;
    const int code = read_names(stream, names);
    ::closedir(stream);
    if (code != 0) return fault("list", path, code);
    std::sort(names.begin(), names.end());
    return names;
  }

  Result<std::uint64_t> free_bytes() override {
    struct statvfs state {};
    if (::fstatvfs(root_.get(), &state) != 0) return fault("ask for the free space of", "", errno);
    return static_cast<std::uint64_t>(state.f_bavail) * state.f_frsize;
  }

 private:
  struct Folder {
    Descriptor descriptor;
    Status status = Done{};
  };

  std::string shown(const std::string& path) const {
    return path.empty() ? name_ : name_ + "/" + path;
  }
  Error fault(const std::string& attempted, const std::string& path, int code) const {
    return storage_error(attempted, shown(path), code);
  }
  Error outside(const std::string& path) const {
    return {"Cannot use '" + path + "' as the path of a file below '" + name_ +
            "': it must be plain names joined by '/'."};
  }
  Status done(int returned, const std::string& attempted, const std::string& path) const {
    if (returned != 0) return fault(attempted, path, errno);
    return Done{};
  }

  Result<Descriptor> opened(const std::string& attempted, const std::string& path,
                            int flags) const {
    if (!stays_inside(path)) return outside(path);
    Descriptor file(::openat(root_.get(), path.c_str(), flags | O_CLOEXEC, kFileMode));
    if (!file.is_open()) return fault(attempted, path, errno);
    return file;
  }

  Result<std::unique_ptr<WritableFile>> open_for_writing(const std::string& attempted,
                                                         const std::string& path, int flags) {
    auto file = opened(attempted, path, flags | O_WRONLY | O_APPEND);
    if (!file) return file.error();
    return std::unique_ptr<WritableFile>(
        std::make_unique<PosixFile>(std::move(*file), shown(path)));
  }

  Folder opened_folder(const std::string& attempted, const std::string& path) const {
    if (!path.empty() && !stays_inside(path)) return {Descriptor(), outside(path)};
    const std::string name = path.empty() ? "." : path;
    Descriptor folder(::openat(root_.get(), name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!folder.is_open()) return {Descriptor(), fault(attempted, path, errno)};
    return {std::move(folder), Done{}};
  }

  Descriptor root_;
  std::string name_;
};

}  // namespace

Result<std::unique_ptr<Storage>> open_storage(const std::string& folder) {
  Descriptor root(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!root.is_open()) return storage_error("open the folder", folder, errno);
  return std::unique_ptr<Storage>(std::make_unique<PosixStorage>(std::move(root), folder));
}

std::optional<std::string> file_system_warning(const std::string& folder) {
  struct statfs state {};
  if (::statfs(folder.c_str(), &state) != 0) return std::nullopt;
  return file_system_warning(folder, state.f_type);
}

}  // namespace plumbline::posix
