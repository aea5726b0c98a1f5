// SPDX-License-Identifier: MIT
#include "tests/contract/storage_contract.h"

#include <gmock/gmock.h>

namespace plumbline::contract {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void write(Storage& storage, const std::string& path, const std::string& bytes) {
  auto file = storage.append_to(path);
  ASSERT_TRUE(file.ok()) << file.error().sentence;
  const Status appended = (*file)->append(bytes);
  ASSERT_TRUE(appended.ok()) << appended.error().sentence;
}

std::string content(Storage& storage, const std::string& path) {
  const auto bytes = storage.read(path);
  return bytes ? *bytes : "error: " + bytes.error().sentence;
}

std::string sentence(const Status& status) { return status ? "" : status.error().sentence; }

template <typename T>
std::string sentence(const Result<T>& result) {
  return result ? "" : result.error().sentence;
}

TEST_P(StorageContract, IsEmptyAtFirst) {
  const auto names = storage_.list("");
  ASSERT_TRUE(names.ok());
  EXPECT_THAT(*names, IsEmpty());
}

TEST_P(StorageContract, GivesBackWhatWasAppended) {
  write(storage_, "log", "one ");
  write(storage_, "log", std::string("two\0three", 9));
  EXPECT_EQ(content(storage_, "log"), std::string("one two\0three", 13));
}

TEST_P(StorageContract, AppendsOverAMillionBytesWhole) {
  std::string bytes(3'000'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7 % 251);
  write(storage_, "photo", bytes);
  EXPECT_TRUE(content(storage_, "photo") == bytes);
}

TEST_P(StorageContract, SyncsFilesAndFolders) {
  ASSERT_TRUE(storage_.make_folder("photos").ok());
  auto file = storage_.create("photos/1.jpg");
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE((*file)->append("x").ok());
  EXPECT_EQ(sentence((*file)->sync()), "");
  EXPECT_EQ(sentence(storage_.sync_folder("photos")), "");
  EXPECT_EQ(sentence(storage_.sync_folder("")), "");
}

TEST_P(StorageContract, CreatesNoFileThatIsThere) {
  write(storage_, "log", "kept");
  const auto file = storage_.create("log");
  EXPECT_THAT(sentence(file), HasSubstr("log"));
  EXPECT_THAT(sentence(file), HasSubstr("there already"));
  EXPECT_EQ(content(storage_, "log"), "kept");
}

TEST_P(StorageContract, RenamesOverAnOlderFile) {
  write(storage_, "old", "old");
  write(storage_, "new", "new");
  ASSERT_TRUE(storage_.rename("new", "old").ok());
  EXPECT_EQ(content(storage_, "old"), "new");
  EXPECT_THAT(*storage_.list(""), ElementsAre("old"));
}

TEST_P(StorageContract, ShortensAFileToAValidPrefix) {
  write(storage_, "log", "whole torn");
  ASSERT_TRUE(storage_.truncate("log", 5).ok());
  EXPECT_EQ(content(storage_, "log"), "whole");
  write(storage_, "log", " again");
  EXPECT_EQ(content(storage_, "log"), "whole again");
}

TEST_P(StorageContract, MakesFoldersWithTheirParentsOnceOrTwice) {
  ASSERT_TRUE(storage_.make_folder("a/b/c").ok());
  ASSERT_TRUE(storage_.make_folder("a/b/c").ok());
  write(storage_, "a/b/c/d", "deep");
  EXPECT_THAT(*storage_.list("a/b"), ElementsAre("c"));
  EXPECT_EQ(content(storage_, "a/b/c/d"), "deep");
}

TEST_P(StorageContract, ListsNamesInOrder) {
  for (const char* name : {"b", "a", "10", "9"}) write(storage_, name, "");
  EXPECT_THAT(*storage_.list(""), ElementsAre("10", "9", "a", "b"));
}

TEST_P(StorageContract, RemovesOneFile) {
  write(storage_, "a", "1");
  write(storage_, "b", "2");
  ASSERT_TRUE(storage_.remove("a").ok());
  EXPECT_THAT(*storage_.list(""), ElementsAre("b"));
}

TEST_P(StorageContract, SaysWhichFileIsMissing) {
  for (const std::string& said :
       {sentence(storage_.read("none")), sentence(storage_.remove("none")),
        sentence(storage_.rename("none", "b")), sentence(storage_.truncate("none", 0)),
        sentence(storage_.list("none"))}) {
    EXPECT_THAT(said, HasSubstr("none'"));
    EXPECT_THAT(said, HasSubstr("there is no such"));
  }
  EXPECT_THAT(sentence(storage_.create("none/file")), HasSubstr("there is no such"));
}

TEST_P(StorageContract, SaysThatAFullDiskWantsSpaceAndGoesOnWhenThereIs) {
  write(storage_, "log", "before");
  auto file = storage_.append_to("log");
  ASSERT_TRUE(file.ok());
  bench_->allow_bytes(10);
  const Status appended = (*file)->append(" and too much");
  bench_->allow_all();
  EXPECT_THAT(sentence(appended), HasSubstr("log"));
  EXPECT_THAT(content(storage_, "log"), HasSubstr("before"));
  ASSERT_TRUE(storage_.truncate("log", 6).ok());
  EXPECT_TRUE((*file)->append(" and after").ok());
  EXPECT_EQ(content(storage_, "log"), "before and after");
}

TEST_P(StorageContract, KnowsItsFreeSpace) {
  const auto bytes = storage_.free_bytes();
  ASSERT_TRUE(bytes.ok());
  EXPECT_GT(*bytes, 0u);
}

TEST_P(StorageContract, PublishesAFileWholeAndInPlaceOfAnOlderOne) {
  ASSERT_TRUE(storage_.make_folder("photos").ok());
  EXPECT_EQ(sentence(publish(storage_, "photos/1.jpg", "old")), "");
  EXPECT_EQ(sentence(publish(storage_, "photos/1.jpg", "new")), "");
  EXPECT_EQ(content(storage_, "photos/1.jpg"), "new");
  EXPECT_THAT(*storage_.list("photos"), ElementsAre("1.jpg"));
}

TEST_P(StorageContract, LeavesNoPartOfAFileThatCouldNotBePublished) {
  ASSERT_TRUE(publish(storage_, "a", "old").ok());
  bench_->allow_bytes(10);
  EXPECT_NE(sentence(publish(storage_, "a", std::string(100, 'x'))), "");
  bench_->allow_all();
  EXPECT_EQ(content(storage_, "a"), "old");
  EXPECT_THAT(*storage_.list(""), ElementsAre("a"));
}

}  // namespace
}  // namespace plumbline::contract
