// SPDX-License-Identifier: MIT
#include "tests/architecture/source_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumbline::architecture {
namespace {

using testing::ElementsAre;

TEST(CodeOnly, BlanksCommentsAndKeepsEveryCharacterInItsPlace) {
  EXPECT_EQ(code_only("a; // b\nc; /* d\ne */ f;"), "a;     \nc;     \n     f;");
}

TEST(CodeOnly, BlanksTheInsidesOfLiterals) {
  EXPECT_EQ(code_only(R"(f("}{", '{', "\"{");)"), R"(f("  ", ' ', "   ");)");
}

TEST(CodeOnly, TakesACommentMarkInAStringForText) {
  EXPECT_EQ(code_only("f(\"// x\"); g();"), "f(\"    \"); g();");
}

TEST(CodeOnly, KnowsRawStringsWithDelimiters) {
  EXPECT_EQ(code_only("R\"x({ \")\" })x\" {"), "R\"" + std::string(11, ' ') + "\" {");
}

TEST(CodeOnly, TakesADigitSeparatorForPartOfItsNumber) {
  EXPECT_EQ(code_only("int a = 1'000; char b = '{';"), "int a = 1'000; char b = ' ';");
}

TEST(LinesOf, CountsALastLineWithoutAnEnd) {
  EXPECT_THAT(lines_of("a\n\nb"), ElementsAre("a", "", "b"));
  EXPECT_THAT(lines_of("a\n"), ElementsAre("a"));
  EXPECT_THAT(lines_of(""), ElementsAre());
}

}  // namespace
}  // namespace plumbline::architecture
