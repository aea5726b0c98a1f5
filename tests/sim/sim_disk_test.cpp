// SPDX-License-Identifier: MIT
#include "sim/sim_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "sim/virtual_clock.h"

namespace plumbline::sim {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

using Discipline = std::function<Status(Storage&, const std::string&, std::string_view)>;

Status write_synced(Storage& storage, const std::string& path, std::string_view bytes, bool sync) {
  auto file = storage.create(path);
  if (!file) return file.error();
  if (const Status appended = (*file)->append(bytes); !appended) return appended;
  return sync ? (*file)->sync() : Status(Done{});
}

// publish() with a step left out.
Discipline careless(bool sync_file, bool sync_folder) {
  return [=](Storage& storage, const std::string& path, std::string_view bytes) -> Status {
    const Status written = write_synced(storage, path + ".part", bytes, sync_file);
    if (!written) return written;
    if (const Status renamed = storage.rename(path + ".part", path); !renamed) return renamed;
    return sync_folder ? storage.sync_folder("") : Status(Done{});
  };
}

Status in_place(Storage& storage, const std::string& path, std::string_view bytes) {
  const Status gone = storage.remove(path);
  if (const Status written = write_synced(storage, path, bytes, true); !written) return written;
  return storage.sync_folder("");
}

const std::string kOld(3000, 'o');
const std::string kNew(5000, 'n');

std::string found(SimDisk& disk) {
  const auto bytes = disk.read("file");
  if (!bytes) return "missing";
  return *bytes == kOld ? "old" : *bytes == kNew ? "new" : "torn";
}

struct Crashes {
  std::set<std::string> during;  // what was found after a cut in the middle
  std::set<std::string> after;   // and after a cut when all was done
};

void crash(const Discipline& replace, std::uint64_t seed, std::optional<std::uint64_t> cut_at,
           std::set<std::string>& seen) {
  SimDisk disk;
  ASSERT_TRUE(publish(disk, "file", kOld).ok());
  if (cut_at) disk.fail(disk.operations() + *cut_at, DiskFault::kPowerCut);
  const Status replaced = replace(disk, "file", kNew);
  EXPECT_EQ(replaced.ok(), !cut_at.has_value());
  Random random(seed, 1);
  seen.insert(found(*disk.after_power_cut(random)));
}

// A cut at every operation, and many ways in which the disk may come back from each.
Crashes crash_everywhere(const Discipline& replace) {
  SimDisk probe;
  EXPECT_TRUE(publish(probe, "file", kOld).ok());
  const std::uint64_t before = probe.operations();
  EXPECT_TRUE(replace(probe, "file", kNew).ok());
  const std::uint64_t operations = probe.operations() - before;
  Crashes crashes;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    for (std::uint64_t at = 0; at < operations; ++at) crash(replace, seed, at, crashes.during);
    crash(replace, seed, std::nullopt, crashes.after);
  }
  return crashes;
}

TEST(SimDiskCrash, LeavesAPublishedFileOldOrNewAndNewWhenItWasDone) {
  const Crashes crashes = crash_everywhere(publish);
  EXPECT_THAT(crashes.during, UnorderedElementsAre("old", "new"));
  EXPECT_THAT(crashes.after, UnorderedElementsAre("new"));
}

TEST(SimDiskCrash, CatchesARenameBeforeTheDataAreOnTheDisk) {
  const Crashes crashes = crash_everywhere(careless(false, true));
  EXPECT_TRUE(crashes.after.contains("torn"));
}

TEST(SimDiskCrash, CatchesAFolderThatIsNotSynced) {
  const Crashes crashes = crash_everywhere(careless(true, false));
  EXPECT_THAT(crashes.after, UnorderedElementsAre("old", "new"));
}

TEST(SimDiskCrash, CatchesAFileThatIsWrittenInPlace) {
  const Crashes crashes = crash_everywhere(in_place);
  EXPECT_TRUE(crashes.during.contains("missing"));
  EXPECT_TRUE(crashes.during.contains("torn"));
}

TEST(SimDiskCrash, KeepsWhatALogHadSyncedAndNothingElseForCertain) {
  std::set<std::size_t> lengths;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SimDisk disk;
    auto log = disk.create("log");
    ASSERT_TRUE((*log)->append("synced").ok() && (*log)->sync().ok() && disk.sync_folder("").ok());
    ASSERT_TRUE((*log)->append(std::string(2000, 'x')).ok());
    Random random(seed, 2);
    const auto bytes = disk.after_power_cut(random)->read("log");
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(bytes->substr(0, 6), "synced");
    lengths.insert(bytes->size());
  }
  EXPECT_EQ(*lengths.begin(), 6u);
  EXPECT_EQ(*lengths.rbegin(), 2006u);
  EXPECT_GT(lengths.size(), 10u);
}

TEST(SimDiskCrash, LosesAFileWithTheFolderThatWasNotSynced) {
  int lost = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SimDisk disk;
    ASSERT_TRUE(disk.make_folder("photos").ok());
    ASSERT_TRUE(publish(disk, "photos/1.jpg", "x").ok());
    Random random(seed, 3);
    lost += disk.after_power_cut(random)->read("photos/1.jpg").ok() ? 0 : 1;
  }
  EXPECT_GT(lost, 20);
  EXPECT_LT(lost, 80);
}

TEST(SimDisk, LosesForGoodWhatAFailedSyncShouldHaveSaved) {
  SimDisk disk;
  auto file = disk.create("file");
  ASSERT_TRUE((*file)->append("lost").ok());
  disk.fail(disk.operations(), DiskFault::kFails);
  const Status failed = (*file)->sync();
  ASSERT_FALSE(failed.ok());
  EXPECT_THAT(failed.error().sentence, HasSubstr("'file'"));
  EXPECT_TRUE((*file)->sync().ok());
  EXPECT_NE(*disk.read("file"), "lost");
}

TEST(SimDisk, SaysThatThePowerIsOffToWhoeverGoesOn) {
  SimDisk disk;
  disk.fail(0, DiskFault::kPowerCut);
  EXPECT_THAT(disk.create("a").error().sentence, HasSubstr("power went off"));
  EXPECT_THAT(disk.list("").error().sentence, HasSubstr("power is off"));
}

TEST(SimDisk, IsFullAtExactlyItsCapacityWhateverTheFile) {
  SimDisk disk(10);
  auto one = disk.create("one");
  auto two = disk.create("two");
  ASSERT_TRUE((*one)->append("123456").ok());
  EXPECT_EQ(*disk.free_bytes(), 4u);
  ASSERT_TRUE((*two)->append("1234").ok());
  EXPECT_EQ(*disk.free_bytes(), 0u);
  const Status refused = (*one)->append("7");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().sentence, HasSubstr("disk is full"));
  EXPECT_EQ(*disk.read("one"), "123456");
  ASSERT_TRUE(disk.remove("two").ok());
  EXPECT_TRUE((*one)->append("7890").ok());
}

TEST(SimDisk, TakesItsTimeForEachSyncOnAVirtualClock) {
  VirtualClock clock;
  SimDisk disk;
  disk.slow_down(seconds(2), [&](auto time) { clock.run_until(clock.now() + time); });
  ASSERT_TRUE(publish(disk, "photo", "bytes").ok());  // a sync of the file, one of the folder
  EXPECT_EQ(clock.now(), HostTime(seconds(4)));
  disk.slow_down(seconds(0), nullptr);
  ASSERT_TRUE(publish(disk, "photo", "more bytes").ok());
  EXPECT_EQ(clock.now(), HostTime(seconds(4)));
}

TEST(SimDisk, ServesOthersWhileASyncTakesItsTime) {
  VirtualClock clock;
  SimDisk disk;
  disk.slow_down(seconds(2), [&](auto time) { clock.run_until(clock.now() + time); });
  auto file = disk.create("slow");
  ASSERT_TRUE((*file)->append("bytes").ok());
  std::string read;
  clock.after(seconds(1), [&] { read = *disk.read("slow"); });
  ASSERT_TRUE((*file)->sync().ok());
  EXPECT_EQ(read, "bytes");
}

TEST(SimDisk, MayLoseWhatASlowSyncWasSavingWhenThePowerWasCut) {
  Random random(3, 1);
  int kept = 0;
  for (int i = 0; i < 100; ++i) {
    VirtualClock clock;
    SimDisk disk;
    auto file = disk.create("file");
    ASSERT_TRUE(disk.sync_folder("").ok());
    ASSERT_TRUE((*file)->append("bytes").ok());
    disk.slow_down(seconds(2), [&](auto time) { clock.run_until(clock.now() + time); });
    std::unique_ptr<SimDisk> cut;
    clock.after(seconds(1), [&] { cut = disk.after_power_cut(random); });
    ASSERT_TRUE((*file)->sync().ok());
    kept += *cut->read("file") == "bytes" ? 1 : 0;
    EXPECT_EQ(*disk.after_power_cut(random)->read("file"), "bytes");
  }
  EXPECT_GT(kept, 10);
  EXPECT_LT(kept, 90);
}

TEST(SimDisk, IsWithoutAFolderThatWasTakenAwayAlsoAfterAPowerCut) {
  Random random(3, 1);
  SimDisk disk;
  for (const char* folder : {"0001", "00011"}) {
    ASSERT_TRUE(disk.make_folder(folder));
    ASSERT_TRUE(publish(disk, folder + std::string("/file"), "bytes"));
  }
  auto unsynced = disk.create("0001/other");
  EXPECT_EQ(disk.used_bytes(), 10u);
  disk.take_away("0001");
  EXPECT_EQ(*disk.list(""), std::vector<std::string>{"00011"});
  EXPECT_EQ(disk.used_bytes(), 5u);
  ASSERT_TRUE(disk.sync_folder(""));
  EXPECT_EQ(*disk.after_power_cut(random)->list(""), std::vector<std::string>{"00011"});
}

}  // namespace
}  // namespace plumbline::sim
