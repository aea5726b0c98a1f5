// SPDX-License-Identifier: MIT
#include "tests/architecture/style_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumbline::architecture {
namespace {

std::string repeated(const std::string& line, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += line;
  return text;
}

TEST(MissingLicence, WantsItInTheFirstLine) {
  EXPECT_TRUE(missing_licence({"a.cpp", "// SPDX-License-Identifier: MIT\nint a;\n"}).empty());
  EXPECT_FALSE(missing_licence({"a.cpp", "\n// SPDX-License-Identifier: MIT\n"}).empty());
  EXPECT_FALSE(missing_licence({"a.h", ""}).empty());
  EXPECT_FALSE(missing_licence({"CMakeLists.txt", "#SPDX-License-Identifier: MIT\n"}).empty());
}

TEST(MissingLicence, WantsItInTheSecondLineOfAScript) {
  EXPECT_TRUE(missing_licence({"run", "#!/bin/sh\n# SPDX-License-Identifier: MIT\n"}).empty());
  EXPECT_FALSE(missing_licence({"run", "#!/bin/sh\necho\n"}).empty());
}

TEST(MissingLicence, AsksNothingOfDocuments) {
  EXPECT_TRUE(missing_licence({"README.md", "# Plumbline\n"}).empty());
}

TEST(Oversized, AllowsFiveHundredLinesAndNotOneMore) {
  EXPECT_TRUE(oversized({"a.cpp", repeated("int a;\n", 500)}).empty());
  EXPECT_FALSE(oversized({"a.cpp", repeated("int a;\n", 501)}).empty());
}

TEST(Oversized, AllowsAFunctionOfSixtyLinesAndNotOneMore) {
  EXPECT_TRUE(oversized({"a.cpp", "void f() {\n" + repeated("a();\n", 58) + "}\n"}).empty());
  EXPECT_FALSE(oversized({"a.cpp", "void f() {\n" + repeated("a();\n", 59) + "}\n"}).empty());
}

TEST(UnguardedHeader, WantsPragmaOnceInHeadersOnly) {
  EXPECT_TRUE(unguarded_header({"a.h", "//\n#pragma once\nint a;\n"}).empty());
  EXPECT_FALSE(unguarded_header({"a.h", "//\nint a;\n"}).empty());
  EXPECT_TRUE(unguarded_header({"a.cpp", "int a;\n"}).empty());
}

TEST(Leftovers, FindsMarksOfUnfinishedWork) {
  EXPECT_FALSE(leftovers({"a.cpp",
                          "// TO"
                          "DO: later\n"})
                   .empty());
  EXPECT_TRUE(leftovers({"a.cpp", "// a method of its own\n"}).empty());
}

TEST(Leftovers, FindsPathsOfOneMachine) {
  EXPECT_FALSE(leftovers({"a.cpp",
                          "open(\"/ho"
                          "me/me/x\");\n"})
                   .empty());
  EXPECT_FALSE(leftovers({"a.md",
                          "see /wo"
                          "rk/x\n"})
                   .empty());
  EXPECT_TRUE(leftovers({"a.md", "see docs/work/x and /etc/plumbline\n"}).empty());
}

TEST(Leftovers, FindsHostNamesOfPackageRegistries) {
  EXPECT_FALSE(leftovers({"a",
                          "curl https://deb.deb"
                          "ian.org\n"})
                   .empty());
}

}  // namespace
}  // namespace plumbline::architecture
