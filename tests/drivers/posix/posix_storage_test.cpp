// SPDX-License-Identifier: MIT
#include "drivers/posix/posix_storage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/fsuid.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <functional>
#include <thread>

#include "drivers/posix/storage_errors.h"

namespace plumbline::posix {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Lt;

// An empty folder, and the storage on it.
class PosixStorageTest : public ::testing::Test {
 protected:
  PosixStorageTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "plumbline-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data()) != nullptr ? pattern : "";
  }
  ~PosixStorageTest() override {
    ::chmod(folder_.c_str(), 0700);
    std::filesystem::remove_all(folder_);
  }

  std::unique_ptr<Storage> opened() const {
    auto storage = open_storage(folder_);
    if (!storage) ADD_FAILURE() << storage.error().sentence;
    return storage ? std::move(*storage) : nullptr;
  }

  // Runs `work` on a thread that alone sees a file system in memory of 64 KiB on the folder. False
  // where that is not permitted.
  bool on_a_small_disk(const std::function<void()>& work) const {
    bool mounted = false;
    std::thread([&] {
      mounted = ::unshare(CLONE_NEWNS) == 0 &&
                ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
      if (mounted) work();
    }).join();  // and the disk is gone with the thread
    return mounted;
  }

  std::string folder_;
};

constexpr const char* kNoMount = "mounting a file system is not permitted here";

std::string sentence(const Status& status) { return status ? "" : status.error().sentence; }

Status write(Storage& storage, const std::string& path, std::string_view bytes) {
  auto file = storage.append_to(path);
  return file ? (*file)->append(bytes) : Status(file.error());
}

TEST_F(PosixStorageTest, SaysThatTheDiskIsFullAndGoesOnWhenThereIsSpace) {
  const auto work = [this] {
    const auto storage = opened();
    EXPECT_EQ(sentence(write(*storage, "old", std::string(40'000, 'o'))), "");
    const Status full = write(*storage, "log", std::string(40'000, 'x'));
    EXPECT_EQ(sentence(full),
              "Cannot write '" + folder_ + "/log': the disk is full; make space on it.");
    EXPECT_THAT(storage->read("log")->size(), Lt(40'000u));
    EXPECT_EQ(*storage->read("old"), std::string(40'000, 'o'));
    EXPECT_LT(*storage->free_bytes(), 4096u);
    EXPECT_TRUE(storage->remove("old").ok() && storage->truncate("log", 0).ok());
    EXPECT_EQ(sentence(write(*storage, "log", std::string(40'000, 'y'))), "");
  };
  if (!on_a_small_disk(work)) GTEST_SKIP() << kNoMount;
}

TEST_F(PosixStorageTest, KeepsTheOldFileWhereTheNewOneFindsNoSpace) {
  const auto work = [this] {
    const auto storage = opened();
    EXPECT_EQ(sentence(publish(*storage, "photo", std::string(40'000, 'o'))), "");
    EXPECT_THAT(sentence(publish(*storage, "photo", std::string(40'000, 'n'))),
                HasSubstr("the disk is full"));
    EXPECT_EQ(*storage->read("photo"), std::string(40'000, 'o'));
    EXPECT_THAT(*storage->list(""), ElementsAre("photo"));
  };
  if (!on_a_small_disk(work)) GTEST_SKIP() << kNoMount;
}

TEST_F(PosixStorageTest, SaysThatTheFileSystemIsReadOnly) {
  const auto work = [this] {
    const auto storage = opened();
    EXPECT_EQ(sentence(write(*storage, "log", "kept")), "");
    EXPECT_EQ(::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
    for (const Status& refused : {write(*storage, "log", "x"), publish(*storage, "photo", "x"),
                                  storage->remove("log"), storage->make_folder("photos")})
      EXPECT_THAT(sentence(refused), HasSubstr("read-only; mount it for writing"));
    EXPECT_EQ(*storage->read("log"), "kept");
  };
  if (!on_a_small_disk(work)) GTEST_SKIP() << kNoMount;
}

// Root may do everything: its thread takes the identity of nobody for file accesses.
TEST_F(PosixStorageTest, SaysThatThereIsNoRight) {
  const auto storage = opened();
  ASSERT_EQ(::chmod(folder_.c_str(), 0555), 0);
  std::thread([&] {
    if (::geteuid() == 0) ::setfsuid(65534);
    EXPECT_THAT(sentence(write(*storage, "log", "x")), HasSubstr("no right to; check the owner"));
  }).join();
}

TEST_F(PosixStorageTest, OutlivesTheSignalOfALimitOnTheSizeOfFiles) {
  const auto storage = opened();
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status refused = write(*storage, "log", std::string(2000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(sentence(refused), HasSubstr("raise the limit on file sizes"));
  EXPECT_EQ(storage->read("log")->size(), 1000u);
}

TEST_F(PosixStorageTest, TouchesNothingOutsideItsFolder) {
  const auto storage = opened();
  for (const char* path : {"..", "../x", "a/../../x", "/etc/x", "a//x", "./x", "x/", ""}) {
    EXPECT_THAT(storage->create(path).error().sentence, HasSubstr("plain names")) << path;
    EXPECT_THAT(sentence(storage->remove(path)), HasSubstr("plain names")) << path;
    EXPECT_THAT(sentence(storage->make_folder(path)), HasSubstr("plain names")) << path;
    EXPECT_THAT(sentence(storage->rename("a", path)), HasSubstr("plain names")) << path;
  }
}

TEST_F(PosixStorageTest, StaysWithItsFolderWhereverThatIsMoved) {
  const auto storage = opened();
  const std::string elsewhere = folder_ + "-moved";
  std::filesystem::rename(folder_, elsewhere);
  EXPECT_EQ(sentence(write(*storage, "log", "x")), "");
  EXPECT_TRUE(std::filesystem::exists(elsewhere + "/log"));
  std::filesystem::rename(elsewhere, folder_);
}

TEST_F(PosixStorageTest, SaysWhichFileIsInTheWayOfAFolder) {
  const auto storage = opened();
  ASSERT_TRUE(write(*storage, "photos", "").ok());
  EXPECT_THAT(sentence(storage->make_folder("photos")), HasSubstr("/photos'"));
  EXPECT_FALSE(storage->make_folder("photos/1").ok());
}

TEST(OpenStorage, SaysWhichFolderIsMissing) {
  EXPECT_EQ(open_storage("/none/such").error().sentence,
            "Cannot open the folder '/none/such': there is no such file or folder.");
}

TEST(StorageErrors, AreOneSentenceThatNamesTheFile) {
  for (const int code : {ENOSPC, EDQUOT, EROFS, EIO, EFBIG, EACCES, EPERM, ENOENT, EEXIST, EISDIR,
                         ENOTDIR, ENODEV, ENXIO, ENAMETOOLONG}) {
    const std::string said = storage_error("write", "disk/log", code).sentence;
    EXPECT_THAT(said, HasSubstr("Cannot write 'disk/log': "));
    EXPECT_EQ(said.find('.'), said.size() - 1) << said;
  }
}

TEST(FileSystemWarning, IsGivenForFatOnly) {
  for (const long fat : {0x4d44L, 0x2011BAB0L})
    EXPECT_THAT(file_system_warning("card", fat).value_or(""), HasSubstr("format the card"));
  constexpr long kExt4 = 0xEF53;
  EXPECT_FALSE(file_system_warning("card", kExt4).has_value());
  EXPECT_FALSE(file_system_warning("/proc").has_value());
}

}  // namespace
}  // namespace plumbline::posix
