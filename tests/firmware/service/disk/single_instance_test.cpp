// SPDX-License-Identifier: MIT
#include "firmware/service/disk/single_instance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

using ::testing::HasSubstr;

TEST(TwoDaemons, DoNotRecordIntoOneFolder) {
  const ingest::TemporaryFolder flights;
  std::optional<SingleInstance> first;
  {
    auto held = SingleInstance::in(flights.path().string());
    ASSERT_TRUE(held);
    first.emplace(std::move(*held));
  }
  const auto second = SingleInstance::in(flights.path().string());
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().sentence, HasSubstr("Another plumblined records into"));
  EXPECT_THAT(second.error().sentence, HasSubstr("stop it first"));

  first.reset();
  EXPECT_TRUE(SingleInstance::in(flights.path().string()));
}

TEST(TwoDaemons, RecordIntoTwoFolders) {
  const ingest::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "other");
  const auto first = SingleInstance::in(folder.path().string());
  EXPECT_TRUE(first);
  EXPECT_TRUE(SingleInstance::in((folder / "other").string()));
}

TEST(TwoDaemons, AreNotSeenWhereTheFolderIsNotThere) {
  const ingest::TemporaryFolder folder;
  const auto none = SingleInstance::in((folder / "flights").string());
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().sentence, HasSubstr("flights/.lock: No such file or directory"));
  EXPECT_THAT(none.error().sentence, HasSubstr("recording.folder"));
}

}  // namespace
}  // namespace plumbline::service
