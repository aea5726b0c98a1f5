// SPDX-License-Identifier: MIT
#include "firmware/ingest/csv_table.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "firmware/ingest/number.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

// The number of bytes of the UTF-8 character at the start of `text`; 0 where it is none (RFC 3629,
// without its finer points: overlong forms and surrogates pass).
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80             ? 1
                             : (first & 0xE0) == 0xC0 ? 2
                             : (first & 0xF0) == 0xE0 ? 3
                             : (first & 0xF8) == 0xF0 ? 4
                                                      : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

bool is_text(std::string_view line) {
  while (!line.empty()) {
    const std::size_t length = utf8_length(line);
    if (length == 0 || line.front() == '\0') return false;
    line.remove_prefix(length);
  }
  return true;
}

// Takes the cell at the start of `rest` and the comma behind it; empty where a quote stays open or
// is followed by something else than a comma.
std::optional<std::string> take_quoted_cell(std::string_view& rest) {
  std::string cell;
  rest.remove_prefix(1);
  while (!rest.empty()) {
    const bool doubled = rest.starts_with("\"\"");
    if (rest.front() == '"' && !doubled) {
      rest = trimmed(rest.substr(1));
      if (!rest.empty() && rest.front() != ',') return std::nullopt;
      return cell;
    }
    cell += rest.front();
    rest.remove_prefix(doubled ? 2 : 1);
  }
  return std::nullopt;
}

std::optional<std::vector<std::string>> split(std::string_view line) {
  std::vector<std::string> cells;
  std::string_view rest = line;
  while (true) {
    const std::size_t blank = rest.find_first_not_of(" \t");
    rest.remove_prefix(blank == std::string_view::npos ? rest.size() : blank);
    if (rest.starts_with('"')) {
      const std::optional<std::string> cell = take_quoted_cell(rest);
      if (!cell) return std::nullopt;
      cells.push_back(*cell);
    } else {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      cells.emplace_back(trimmed(rest.substr(0, comma)));
      rest.remove_prefix(comma);
    }
    if (rest.empty()) return cells;
    rest.remove_prefix(1);
  }
}

class Parser {
 public:
  explicit Parser(const std::string& name) { table_.name = name; }

  Result<CsvTable> parse(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.find('\n') == std::string_view::npos &&
        trimmed(text).find('\r') != std::string_view::npos)
      return Error{table_.name + ": lines end with CR alone; save the table with LF or CRLF."};
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      const Status taken = take(trimmed(text.substr(0, end)));
      if (!taken) return taken.error();
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (table_.header_line == 0) {
      return Error{table_.name + ": the file is empty; a header line with column names is wanted."};
    }
    return std::move(table_);
  }

 private:
  Error bad(const std::string& sentence) const { return {at_line(table_.name, line_) + sentence}; }

  Status take(std::string_view line) {
    if (line.empty() || line.front() == '#') return Done{};
    if (!is_text(line)) return bad("not UTF-8 text; save the table as CSV in UTF-8.");
    std::optional<std::vector<std::string>> cells = split(line);
    if (!cells) return bad("a quoted cell is not closed, or is followed by more than a comma.");
    if (table_.header_line == 0) return take_header(std::move(*cells));
    if (cells->size() != table_.columns.size()) {
      return bad("the row has " + std::to_string(cells->size()) + " cells, the header " +
                 std::to_string(table_.columns.size()) + ".");
    }
    table_.rows.push_back({line_, std::move(*cells)});
    return Done{};
  }

  Status take_header(std::vector<std::string> names) {
    if (names.size() == 1 && names[0].find_first_of(";\t") != std::string::npos)
      return bad("cells are separated by commas, not by semicolons or tabs.");
    for (const std::string& name : names) {
      if (!name.empty() && std::ranges::count(names, name) > 1) {
        return bad("the column " + in_quotes(name) + " is there twice.");
      }
    }
    table_.header_line = line_;
    table_.columns = std::move(names);
    return Done{};
  }

  CsvTable table_;
  std::size_t line_ = 0;
};

}  // namespace

Result<CsvTable> parse_csv(const std::string& text, const std::string& name) {
  return Parser(name).parse(text);
}

Result<CsvTable> read_csv(const std::filesystem::path& path) {
  const Result<std::string> text = read_text_file(path);
  if (!text) return text.error();
  return parse_csv(*text, path.filename().string());
}

}  // namespace plumbline::ingest
