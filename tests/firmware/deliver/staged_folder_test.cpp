// SPDX-License-Identifier: MIT
#include "firmware/deliver/staged_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>

#include "firmware/deliver/held_folder.h"
#include "tests/firmware/deliver/files_of.h"

namespace plumbline::deliver {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

const std::vector<NamedFile> kTwo = {{"a.csv", "new a"}, {"b.csv", "new b"}};

std::vector<NamedFile> big() { return {{"a.csv", "new a"}, {"b.csv", std::string(1 << 20, 'x')}}; }

void put(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path) << content;
}

TEST(StagedFolder, MakesTheFolderAndThoseAboveIt) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write_all_or_nothing(scratch.path() / "x/y/result/", kTwo, {}).ok());
  EXPECT_THAT(files_of(scratch.path() / "x/y/result"),
              ElementsAre(Pair("a.csv", "new a"), Pair("b.csv", "new b")));
  EXPECT_EQ(files_of(scratch.path()).size(), 5u);
}

TEST(StagedFolder, GivesTheFolderTheRightsOfAPlainMkdir) {
  const ScratchFolder scratch;
  const mode_t before = ::umask(022);
  ASSERT_TRUE(write_all_or_nothing(scratch.path() / "result", kTwo, {}).ok());
  ::umask(before);
  struct stat folder {};
  struct stat file {};
  ASSERT_EQ(::stat((scratch.path() / "result").c_str(), &folder), 0);
  ASSERT_EQ(::stat((scratch.path() / "result/a.csv").c_str(), &file), 0);
  EXPECT_EQ(folder.st_mode & 0777u, 0755u);
  EXPECT_EQ(file.st_mode & 0777u, 0644u);
}

TEST(StagedFolder, ReplacesItsOwnFilesRemovesObsoleteOnesAndLeavesOthersAlone) {
  const ScratchFolder scratch;
  put(scratch.path() / "a.csv", "old a");
  put(scratch.path() / "check.csv", "old check");
  put(scratch.path() / "mine.txt", "mine");
  ASSERT_TRUE(write_all_or_nothing(scratch.path(), kTwo, {"check.csv"}).ok());
  EXPECT_THAT(files_of(scratch.path()), ElementsAre(Pair("a.csv", "new a"), Pair("b.csv", "new b"),
                                                    Pair("mine.txt", "mine")));
}

TEST(StagedFolder, PutsTheOldFilesBackWhereOneCannotBeMovedIn) {
  const ScratchFolder scratch;
  put(scratch.path() / "a.csv", "old a");
  const std::vector<NamedFile> with_impossible_name = {{"a.csv", "new a"},
                                                       {"missing/b.csv", "new b"}};
  EXPECT_FALSE(write_all_or_nothing(scratch.path(), with_impossible_name, {}).ok());
  EXPECT_THAT(files_of(scratch.path()), ElementsAre(Pair("a.csv", "old a")));
}

// Killed while it writes, as where memory ends; of others that are at work nothing is taken.
TEST(StagedFolder, ClearsAwayWhatAKilledProcessLeft) {
  const ScratchFolder scratch;
  const auto result = scratch.path() / "result";
  const auto aged = [](const std::filesystem::path& folder) {
    const struct timespec hour_ago[2] = {{::time(nullptr) - 3600, 0}, {::time(nullptr) - 3600, 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, folder.c_str(), hour_ago, 0), 0);
  };
  const pid_t process = ::fork();
  if (process == 0) {
    HeldFolder left;
    if (left.make_in(scratch.path(), ".plumbline-") != 0) ::_exit(1);
    put(left.path() / "half", "writ");
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(process, nullptr, 0);
  HeldFolder at_work;
  ASSERT_EQ(at_work.make_in(scratch.path(), ".plumbline-"), 0);
  const auto name = [](const auto& entry) { return entry.path(); };
  std::vector<std::filesystem::path> found;
  std::transform(std::filesystem::directory_iterator(scratch.path()), {}, std::back_inserter(found),
                 name);
  ASSERT_EQ(found.size(), 2u) << "just left: it may be at work";
  for (const auto& folder : found) aged(folder);
  std::filesystem::create_directory(scratch.path() / ".plumbline-of-mine");
  aged(scratch.path() / ".plumbline-of-mine");
  ASSERT_TRUE(write_all_or_nothing(result, kTwo, {}).ok());
  found.clear();
  std::transform(std::filesystem::directory_iterator(scratch.path()), {}, std::back_inserter(found),
                 name);
  EXPECT_THAT(found, testing::UnorderedElementsAre(result, at_work.path(),
                                                   scratch.path() / ".plumbline-of-mine"));
}

TEST(StagedFolder, AFileInTheWayIsSaidAndLeft) {
  const ScratchFolder scratch;
  put(scratch.path() / "result", "a file");
  for (const char* place : {"result", "result/deeper"}) {
    const Status status = write_all_or_nothing(scratch.path() / place, kTwo, {});
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().sentence, HasSubstr("A file is in the way"));
  }
  EXPECT_THAT(files_of(scratch.path()), ElementsAre(Pair("result", "a file")));
}

// Limits the size of files as `ulimit -f` does.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited = {bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~SizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST(StagedFolder, ALimitOnFileSizeKillsNothingAndLeavesNothing) {
  const ScratchFolder scratch;
  std::string sentence;
  {
    const SizeLimit limit(100000);
    const Status status = write_all_or_nothing(scratch.path() / "x/result", big(), {});
    ASSERT_FALSE(status.ok());
    sentence = status.error().sentence;
  }
  EXPECT_THAT(sentence, HasSubstr("limit on the size of files"));
  EXPECT_THAT(files_of(scratch.path()), IsEmpty());
}

// A disk of 256 kB, where the system lets us have one.
class SmallDisk {
 public:
  SmallDisk() { mounted_ = ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, "size=256k") == 0; }
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.path().c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool there() const { return mounted_; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
  bool mounted_ = false;
};

TEST(StagedFolder, AFullDiskLeavesNothingBehindInANewFolder) {
  const SmallDisk disk;
  if (!disk.there()) GTEST_SKIP() << "mounting a small tmpfs needs root";
  const Status status = write_all_or_nothing(disk.path() / "deep/result", big(), {});
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().sentence, HasSubstr("The disk is full"));
  EXPECT_THAT(files_of(disk.path()), IsEmpty());
}

// The root of a disk cannot be replaced by renaming a folder over it.
TEST(StagedFolder, AFullDiskLeavesEarlierResultsAsTheyWere) {
  const SmallDisk disk;
  if (!disk.there()) GTEST_SKIP() << "mounting a small tmpfs needs root";
  ASSERT_TRUE(write_all_or_nothing(disk.path(), kTwo, {}).ok());
  EXPECT_FALSE(write_all_or_nothing(disk.path(), big(), {}).ok());
  EXPECT_THAT(files_of(disk.path()), ElementsAre(Pair("a.csv", "new a"), Pair("b.csv", "new b")));
}

// Root may write everywhere, so the test becomes nobody for a moment.
TEST(StagedFolder, AFolderThatIsNotWritableIsSaid) {
  const ScratchFolder scratch;
  ASSERT_EQ(::chmod(scratch.path().c_str(), 0555), 0);
  const bool root = ::geteuid() == 0;
  ASSERT_EQ(root ? ::seteuid(65534) : 0, 0);
  const Status fresh = write_all_or_nothing(scratch.path() / "result", kTwo, {});
  const Status existing = write_all_or_nothing(scratch.path(), kTwo, {});
  ASSERT_EQ(root ? ::seteuid(0) : 0, 0);
  for (const Status& status : {fresh, existing}) {
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().sentence, HasSubstr("is not writable"));
  }
  EXPECT_THAT(files_of(scratch.path()), IsEmpty());
}

}  // namespace
}  // namespace plumbline::deliver
