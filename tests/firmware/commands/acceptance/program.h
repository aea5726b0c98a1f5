// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace plumbline::acceptance {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Outcome {
  int status = -1;  // 128 + n: ended by signal n
  std::string out;
  std::string err;
};

// Runs any program, found by the PATH, in `folder`.
Outcome run_any(const std::vector<std::string>& command, const fs::path& folder);

// Runs the built `plumbline` in `folder`.
Outcome run_plumbline(std::vector<std::string> arguments, const fs::path& folder);

std::string text_of(const fs::path& path);
void write_text(const fs::path& path, const std::string& text);

// File name to content, of all files below `folder`, at any depth.
std::map<std::string, std::string> files_of(const fs::path& folder);

// A CSV without quotes: one map of column to cell per row; comments are skipped.
std::vector<std::map<std::string, std::string>> rows_of(const fs::path& csv);

Json summary_of(const fs::path& result);

// All items of a list of texts, one per line.
std::string lines_of(const Json& list);

// `value` in full precision, for a file.
std::string digits(double value);

}  // namespace plumbline::acceptance
