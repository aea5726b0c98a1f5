// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "edge/base/result.h"

namespace plumbline::ingest {

// A CSV file: UTF-8 (a byte order mark is skipped), lines ended by LF or CRLF, cells separated by
// commas, "quoted" cells with "" for a quote (no line breaks inside), blanks around cells dropped,
// one header line, lines starting with # and empty lines skipped.
struct CsvRow {
  std::size_t line = 0;            // of the file, from 1
  std::vector<std::string> cells;  // as many as there are columns
};

struct CsvTable {
  std::string name;  // the file's, for sentences
  std::size_t header_line = 0;
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;
};

// Fails, with "name:line: sentence", without a header, with two columns of one name, with a row
// that has more or fewer cells than the header, with an open quote, a NUL byte or text that is not
// UTF-8. No rows is not a failure here.
Result<CsvTable> parse_csv(const std::string& text, const std::string& name);
Result<CsvTable> read_csv(const std::filesystem::path& path);

}  // namespace plumbline::ingest
