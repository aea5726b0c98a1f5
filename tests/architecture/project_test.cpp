// SPDX-License-Identifier: MIT
// The rules of the other files of this folder, applied to the project itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "tests/architecture/function_lengths.h"
#include "tests/architecture/include_rules.h"
#include "tests/architecture/project_tree.h"
#include "tests/architecture/style_rules.h"

namespace plumbline::architecture {
namespace {

const std::filesystem::path kRoot = PLUMBLINE_SOURCE_DIR;

using Rule = std::function<std::vector<Violation>(const SourceFile&)>;

std::vector<Violation> broken(const std::vector<SourceFile>& files, const Rule& rule) {
  std::vector<Violation> all;
  for (const SourceFile& file : files) {
    for (Violation& violation : rule(file)) all.push_back(std::move(violation));
  }
  return all;
}

std::vector<int> lengths_in_programs() {
  std::vector<int> lengths;
  for (const SourceFile& file : source_files(kRoot)) {
    if (file.path.starts_with("tests/")) continue;
    for (const FunctionLength& function : function_lengths(file.text)) {
      lengths.push_back(function.lines);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

TEST(Project, IsFound) {
  EXPECT_GT(source_files(kRoot).size(), 20U);
  EXPECT_GT(text_files(kRoot).size(), source_files(kRoot).size());
}

TEST(Project, IncludesRunOneWay) {
  EXPECT_THAT(broken(source_files(kRoot), wrong_arrows), testing::IsEmpty());
}

TEST(Project, LibrariesStayInTheRoomsThatWrapThem) {
  EXPECT_THAT(broken(source_files(kRoot), strayed_libraries), testing::IsEmpty());
}

TEST(Project, MathematicsAndSimulationHaveNoFilesAndNoClocks) {
  EXPECT_THAT(broken(source_files(kRoot), impure_mathematics), testing::IsEmpty());
}

TEST(Project, EveryFileStatesItsLicence) {
  EXPECT_THAT(broken(text_files(kRoot), missing_licence), testing::IsEmpty());
}

TEST(Project, FilesAndFunctionsAreShort) {
  EXPECT_THAT(broken(source_files(kRoot), oversized), testing::IsEmpty());
}

TEST(Project, HalfOfTheFunctionsAreUnderTenLinesAndNineOfTenUnderThirty) {
  const std::vector<int> lengths = lengths_in_programs();
  ASSERT_FALSE(lengths.empty());
  EXPECT_LT(lengths[lengths.size() / 2], 10);
  EXPECT_LT(lengths[lengths.size() * 9 / 10], 30);
}

TEST(Project, HeadersGuardThemselves) {
  EXPECT_THAT(broken(source_files(kRoot), unguarded_header), testing::IsEmpty());
}

TEST(Project, HoldsNoLeftovers) {
  EXPECT_THAT(broken(text_files(kRoot), leftovers), testing::IsEmpty());
}

TEST(Project, HoldsNoLargeFile) {
  const auto files = versioned_files(kRoot);
  if (!files) GTEST_SKIP() << "not a git checkout: which files belong to the project is not known";
  constexpr std::uintmax_t kMostBytes = 300'000;
  for (const FileSize& file : *files) EXPECT_LE(file.bytes, kMostBytes) << file.path;
}

}  // namespace
}  // namespace plumbline::architecture
