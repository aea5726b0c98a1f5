// SPDX-License-Identifier: MIT
#include "firmware/ingest/csv_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/ingest/number.h"
#include "firmware/ingest/table_reader.h"

namespace plumbline::ingest {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string sentence(const std::string& text) {
  const auto table = parse_csv(text, "t.csv");
  return table.ok() ? "" : table.error().sentence;
}

TEST(CsvTable, ReadsWhatSpreadsheetsWrite) {
  const auto table = parse_csv(
      "\xEF\xBB\xBF# by hand\r\n\r\n point , \"u, px\",v\r\n\"A \"\"1\"\"\",1.5, \r\n# "
      "off\r\nB,2,3",
      "t.csv");
  ASSERT_TRUE(table.ok()) << table.error().sentence;
  EXPECT_EQ(table->header_line, 3u);
  EXPECT_THAT(table->columns, ElementsAre("point", "u, px", "v"));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].line, 4u);
  EXPECT_THAT(table->rows[0].cells, ElementsAre("A \"1\"", "1.5", ""));
  EXPECT_EQ(table->rows[1].line, 6u);
  EXPECT_THAT(table->rows[1].cells, ElementsAre("B", "2", "3"));
}

TEST(CsvTable, SaysWhichLineIsWrong) {
  EXPECT_THAT(sentence(""), HasSubstr("empty"));
  EXPECT_THAT(sentence("# only this\n"), HasSubstr("empty"));
  EXPECT_THAT(sentence("a,b\n1,2\n3\n"), StartsWith("t.csv:3: the row has 1 cells"));
  EXPECT_THAT(sentence("a,b\n1,2,3\n"), StartsWith("t.csv:2: "));
  EXPECT_THAT(sentence("a,b,a\n"), HasSubstr("'a' is there twice"));
  EXPECT_THAT(sentence("a\n\"open\n"), HasSubstr("not closed"));
  EXPECT_THAT(sentence("a,b\n\"x\"y,2\n"), HasSubstr("not closed"));
  EXPECT_THAT(sentence("a\n\xFF\n"), HasSubstr("UTF-8"));
  EXPECT_THAT(sentence(std::string("a\n1\0002\n", 6)), HasSubstr("UTF-8"));
  EXPECT_THAT(sentence("a;b\n1;2\n"), StartsWith("t.csv:1: cells are separated by commas"));
  EXPECT_THAT(sentence("a\tb\n1\t2\n"), HasSubstr("tabs"));
  EXPECT_THAT(sentence("a,b\r1,2\r3,4\r"), HasSubstr("LF or CRLF"));
  EXPECT_EQ(sentence("a;b,c\n1,2\n"), "");
  EXPECT_EQ(sentence("a,b\r\n"), "");
  EXPECT_EQ(sentence("点\n測量\n"), "");
}

TEST(ParseNumber, TakesFiniteDecimalsOnly) {
  EXPECT_EQ(parse_number(" +1.5e3 "), 1500);
  EXPECT_EQ(parse_number("-0.25"), -0.25);
  EXPECT_EQ(parse_number(".5"), 0.5);
  for (const char* bad :
       {"", " ", "nan", "inf", "-inf", "1,5", "0x10", "1.5m", "1 2", "--1", "1e999", "+-1"}) {
    EXPECT_EQ(parse_number(bad), std::nullopt) << bad;
  }
}

TEST(TableReader, KeepsTheFirstFaultAndNoticesUnknownColumns) {
  const auto table = parse_csv("point,x_m,sigma_m,colour\nA,1,2,red\nB,nan,-2,\n", "t.csv");
  TableReader reader(*table);
  reader.require({"point", "x_m"});
  EXPECT_EQ(reader.number(table->rows[0], "x_m"), 1);
  EXPECT_EQ(reader.sigma_or_blank(table->rows[0], "sigma_m"), 2);
  EXPECT_EQ(reader.number_or_blank(table->rows[0], "y_m"), std::nullopt);
  EXPECT_FALSE(reader.error());
  reader.number(table->rows[1], "x_m");
  reader.sigma_or_blank(table->rows[1], "sigma_m");
  ASSERT_TRUE(reader.error());
  EXPECT_EQ(reader.error()->sentence, "t.csv:3: 'x_m' is 'nan', which is not a finite number.");
  EXPECT_THAT(reader.notices(),
              ElementsAre("t.csv:1: the column 'colour' is not known and was ignored."));
}

TEST(TableReader, SaysWhichColumnIsMissing) {
  const auto table = parse_csv("point,x\nA,1\n", "t.csv");
  TableReader reader(*table);
  reader.require({"point", "x_m"});
  ASSERT_TRUE(reader.error());
  EXPECT_EQ(reader.error()->sentence, "t.csv:1: the column 'x_m' is missing.");
}

}  // namespace
}  // namespace plumbline::ingest
