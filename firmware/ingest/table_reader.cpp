// SPDX-License-Identifier: MIT
#include "firmware/ingest/table_reader.h"

#include <algorithm>
#include <cmath>

#include "firmware/ingest/number.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

// Beyond any coordinate in metres, pixels or degrees; squares of it still add up.
constexpr double kAbsurd = 1e9;

}  // namespace

std::optional<std::size_t> TableReader::index_of(const std::string& column) {
  asked_for_.insert(column);
  const auto found = std::ranges::find(table_.columns, column);
  if (found == table_.columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table_.columns.begin());
}

bool TableReader::has(const std::string& column) { return index_of(column).has_value(); }

bool TableReader::has_all(const std::vector<std::string>& columns) {
  return std::ranges::count_if(columns, [this](const auto& column) { return has(column); }) ==
         std::ssize(columns);
}

void TableReader::expect(const std::vector<std::string>& columns) {
  asked_for_.insert(columns.begin(), columns.end());
}

void TableReader::require(const std::vector<std::string>& columns) {
  for (const std::string& column : columns) {
    if (has(column) || error_) continue;
    error_ = Error{at_line(table_.name, table_.header_line) + "the column " + in_quotes(column) +
                   " is missing."};
  }
}

std::string TableReader::text_or_blank(const CsvRow& row, const std::string& column) {
  const std::optional<std::size_t> index = index_of(column);
  return index ? row.cells[*index] : "";
}

std::string TableReader::text(const CsvRow& row, const std::string& column) {
  const std::string cell = text_or_blank(row, column);
  if (cell.empty()) fail(row, in_quotes(column) + " is blank.");
  return cell;
}

std::optional<double> TableReader::number_or_blank(const CsvRow& row, const std::string& column) {
  const std::string cell = text_or_blank(row, column);
  if (cell.empty()) return std::nullopt;
  const std::optional<double> value = parse_number(cell);
  if (!value) {
    fail(row, in_quotes(column) + " is " + in_quotes(cell) + ", which is not a finite number.");
  } else if (std::abs(*value) > kAbsurd) {
    fail(row, in_quotes(column) + " is " + cell + ", which is absurdly large.");
  }
  return value;
}

double TableReader::number(const CsvRow& row, const std::string& column) {
  const std::optional<double> value = number_or_blank(row, column);
  if (!value) fail(row, in_quotes(column) + " is blank.");
  return value.value_or(0);
}

std::optional<double> TableReader::sigma_or_blank(const CsvRow& row, const std::string& column) {
  const std::optional<double> value = number_or_blank(row, column);
  if (value && *value < 0) {
    fail(row, in_quotes(column) + " is negative; a standard deviation is 0 or more.");
  }
  return value;
}

void TableReader::fail(const CsvRow& row, const std::string& sentence) {
  if (!error_) error_ = Error{at_line(table_.name, row.line) + sentence};
}

std::vector<std::string> TableReader::notices() const {
  std::vector<std::string> sentences;
  for (const std::string& column : table_.columns) {
    if (asked_for_.contains(column)) continue;
    sentences.push_back(at_line(table_.name, table_.header_line) + "the column " +
                        in_quotes(column) + " is not known and was ignored.");
  }
  return sentences;
}

}  // namespace plumbline::ingest
