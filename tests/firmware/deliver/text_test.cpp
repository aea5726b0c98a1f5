// SPDX-License-Identifier: MIT
#include "firmware/deliver/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline::deliver {
namespace {

TEST(Text, FixedHasTheDecimalsAskedForAndNoMinusZero) {
  EXPECT_EQ(fixed(1.23456, 3), "1.235");
  EXPECT_EQ(fixed(-12.5, 0), "-12");
  EXPECT_EQ(fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed(-0.0, 0), "0");
  EXPECT_EQ(fixed(3939000.5, 2), "3939000.50");
}

TEST(Text, WhatIsNotFiniteIsBlankOrSaidInWords) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(fixed(value, 3), "");
    EXPECT_EQ(significant(value, 3), "");
    EXPECT_EQ(fixed_or(value, 3, "unknown"), "unknown");
    EXPECT_EQ(length_words(value), "unknown");
  }
}

TEST(Text, LengthsForPeopleAreInMillimetresBelowAMetre) {
  EXPECT_EQ(length_words(0.0332), "33 mm");
  EXPECT_EQ(length_words(0.0051), "5.1 mm");
  EXPECT_EQ(length_words(2.9339), "2.93 m");
  EXPECT_EQ(plain(5.0), "5");
  EXPECT_EQ(plain(0.2), "0.2");
  EXPECT_EQ(plain(100.0), "100");
}

TEST(Text, EscapesWhateverCouldEndATextOrAnAttribute) {
  EXPECT_EQ(escaped("<a href='x' title=\"y\">&"),
            "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt;&amp;");
}

TEST(Text, KeepsUtf8AndReplacesWhatIsNone) {
  EXPECT_EQ(clean_utf8("\xe5\x9f\xba\xe6\xba\x96 7"), "\xe5\x9f\xba\xe6\xba\x96 7");
  EXPECT_EQ(clean_utf8("\xf0\x9f\x93\xb7"), "\xf0\x9f\x93\xb7");
  EXPECT_EQ(clean_utf8("a\xff"
                       "b"),
            "a\xef\xbf\xbd"
            "b");
  EXPECT_EQ(clean_utf8("cut \xe5\x9f"), "cut \xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(clean_utf8("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");       // overlong
  EXPECT_EQ(clean_utf8("\xed\xa0\x80").substr(0, 3), "\xef\xbf\xbd");  // surrogate
  EXPECT_EQ(clean_utf8("two\nlines\x01"), "two lines ");
}

}  // namespace
}  // namespace plumbline::deliver
