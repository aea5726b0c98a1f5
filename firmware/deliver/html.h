// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace plumbline::deliver {

// <tag class="...">inner</tag>; `inner` is markup already.
std::string element(const std::string& tag, const std::string& inner,
                    const std::string& style = "");

// A paragraph, a list of plain sentences: escaped here.
std::string paragraph(const std::string& words, const std::string& style = "");
std::string list_of(const std::vector<std::string>& sentences, const std::string& style = "");

// Plain texts in rows and columns.
struct Table {
  std::string caption;
  std::vector<std::string> head;  // "name|unit": the unit is set on a line of its own
  std::vector<std::vector<std::string>> rows;
  std::size_t total_rows = 0;    // so many at the end are totals, and stand out
  std::size_t text_columns = 1;  // from the left; the others are set as numbers, flush right
  std::string note;              // below the table
};
std::string html_table(const Table& table);

}  // namespace plumbline::deliver
