// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "edge/base/result.h"
#include "firmware/ingest/csv_table.h"

namespace plumbline::ingest {

// Cells of a table by column name, as numbers. The first fault is kept (with file and line) and
// what is read after it is worth nothing, so that a reader asks for error() once, at the end of a
// row. A column that was never asked for is unknown and gets a notice.
class TableReader {
 public:
  explicit TableReader(const CsvTable& table) : table_(table) {}

  bool has(const std::string& column);
  bool has_all(const std::vector<std::string>& columns);
  // Known, though no row may ask for them.
  void expect(const std::vector<std::string>& columns);
  // A fault where it is missing.
  void require(const std::vector<std::string>& columns);

  // Not blank.
  std::string text(const CsvRow& row, const std::string& column);
  // "" where blank or without such a column.
  std::string text_or_blank(const CsvRow& row, const std::string& column);
  double number(const CsvRow& row, const std::string& column);
  // Empty where blank or without such a column.
  std::optional<double> number_or_blank(const CsvRow& row, const std::string& column);
  // The same for a standard deviation: 0 or more.
  std::optional<double> sigma_or_blank(const CsvRow& row, const std::string& column);

  void fail(const CsvRow& row, const std::string& sentence);
  const std::optional<Error>& error() const { return error_; }
  std::vector<std::string> notices() const;

 private:
  std::optional<std::size_t> index_of(const std::string& column);

  const CsvTable& table_;
  std::set<std::string, std::less<>> asked_for_;
  std::optional<Error> error_;
};

}  // namespace plumbline::ingest
