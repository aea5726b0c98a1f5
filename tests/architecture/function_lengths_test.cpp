// SPDX-License-Identifier: MIT
#include "tests/architecture/function_lengths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace plumbline::architecture {
namespace {

using testing::ElementsAre;

std::vector<int> lengths(const std::string& text) {
  std::vector<int> lines;
  for (const FunctionLength& function : function_lengths(text)) lines.push_back(function.lines);
  return lines;
}

TEST(FunctionLengths, CountsFromBraceToBraceInsideNamespaces) {
  const auto found = function_lengths("namespace a {\nint f(int x) {\n  return x;\n}\n}\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first_line, 2);
  EXPECT_EQ(found[0].lines, 3);
}

TEST(FunctionLengths, LooksIntoClassesAndTemplates) {
  EXPECT_THAT(lengths("template <typename T>\nclass [[nodiscard]] A : public B<T> {\n"
                      " public:\n  int f() const { return 1; }\n  void g() {\n  }\n};\n"),
              ElementsAre(1, 2));
}

TEST(FunctionLengths, CountsLambdasAndBlocksWithTheirFunction) {
  EXPECT_THAT(lengths("void f() {\n  auto g = [&](int i) {\n    h(i);\n  };\n  if (x) {\n  }\n}\n"),
              ElementsAre(7));
}

TEST(FunctionLengths, PassesOverInitialisersAndEnums) {
  EXPECT_THAT(lengths("const std::vector<int> k = {\n1,\n2};\nenum class E {\n kA };\n"
                      "struct P {\n  V v = V::Zero();\n  int i{0};\n};\n"),
              ElementsAre());
}

TEST(FunctionLengths, TakesAConstructorsBodyAfterItsInitialisers) {
  const std::vector<int> found = lengths("A::A(int b)\n    : b_(b), c_(1) {\n  d();\n}\n");
  EXPECT_THAT(found, ElementsAre(3));
}

TEST(FunctionLengths, KnowsOperators) {
  EXPECT_THAT(lengths("bool operator==(A a, A b) {\n  return true;\n}\n"), ElementsAre(3));
}

TEST(FunctionLengths, IgnoresBracesInLiteralsCommentsAndDirectives) {
  EXPECT_THAT(lengths("void f() {\n  g(\"{{\");  // {\n#define M {\n}\n"), ElementsAre(4));
}

}  // namespace
}  // namespace plumbline::architecture
