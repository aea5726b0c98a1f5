// SPDX-License-Identifier: MIT
#include "firmware/deliver/html.h"

#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

std::string head_cell(const std::string& name, const std::string& style) {
  const std::size_t bar = name.find('|');
  std::string inner = escaped(name.substr(0, bar));
  if (bar != std::string::npos)
    inner += "<br/>" + element("span", escaped(name.substr(bar + 1)), "unit");
  return element("th", inner, style);
}

std::string row_of(const std::vector<std::string>& cells, std::size_t text_columns, bool head,
                   const std::string& row_style = "") {
  std::string inner;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string style = i < text_columns ? "" : "number";
    inner += head ? head_cell(cells[i], style) : element("td", escaped(cells[i]), style);
  }
  return element("tr", inner, row_style) + "\n";
}

}  // namespace

std::string element(const std::string& tag, const std::string& inner, const std::string& style) {
  const std::string open = style.empty() ? tag : tag + " class=\"" + style + "\"";
  return "<" + open + ">" + inner + "</" + tag + ">";
}

std::string paragraph(const std::string& words, const std::string& style) {
  return element("p", escaped(words), style) + "\n";
}

std::string list_of(const std::vector<std::string>& sentences, const std::string& style) {
  if (sentences.empty()) return {};
  std::string inner = "\n";
  for (const std::string& sentence : sentences) inner += element("li", escaped(sentence)) + "\n";
  return element("ul", inner, style) + "\n";
}

std::string html_table(const Table& table) {
  if (table.rows.empty()) return {};
  std::string rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    rows += row_of(table.rows[i], table.text_columns, false,
                   i + table.total_rows >= table.rows.size() ? "total" : "");
  const std::string inner =
      (table.caption.empty() ? "" : element("caption", escaped(table.caption))) +
      element("thead", row_of(table.head, table.text_columns, true)) + element("tbody", rows);
  return element("div", element("table", inner), "scroll") + "\n" +
         (table.note.empty() ? "" : paragraph(table.note, "note"));
}

}  // namespace plumbline::deliver
