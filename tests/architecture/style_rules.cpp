// SPDX-License-Identifier: MIT
#include "tests/architecture/style_rules.h"

#include <cstddef>
#include <regex>
#include <string_view>

#include "tests/architecture/function_lengths.h"

namespace plumbline::architecture {

namespace {

constexpr int kMostLinesOfFile = 500;
constexpr int kMostLinesOfFunction = 60;

bool is_cmake(std::string_view path) {
  return path.ends_with("CMakeLists.txt") || path.ends_with(".cmake");
}

std::string_view licence_comment(const std::string& path) {
  return is_cpp(path) ? "// SPDX-License-Identifier: MIT" : "# SPDX-License-Identifier: MIT";
}

struct Leftover {
  std::regex pattern;
  std::string sentence;
};

// The words are written in pieces, so that this file does not hold them.
const std::vector<Leftover>& leftover_kinds() {
  static const std::vector<Leftover> kinds = {
      {std::regex("\\b(TO"
                  "DO|FIX"
                  "ME|XX"
                  "X|HA"
                  "CK)\\b"),
       "finish it or leave it out"},
      {std::regex("(^|[^\\w.~/}])/(ho"
                  "me|wo"
                  "rk|ro"
                  "ot|Us"
                  "ers)/\\w"),
       "a path of one machine"},
      {std::regex("(pyp"
                  "i\\.org|npm"
                  "js\\.org|deb\\.deb"
                  "ian\\.org|proxy\\.gol"
                  "ang\\.org|crat"
                  "es\\.io)"),
       "package registries are the package manager's business"},
  };
  return kinds;
}

}  // namespace

bool is_cpp(const std::string& path) { return path.ends_with(".cpp") || path.ends_with(".h"); }

std::vector<Violation> missing_licence(const SourceFile& file) {
  const std::vector<std::string_view> lines = lines_of(file.text);
  const bool script = file.text.starts_with("#!");
  if (!script && !is_cpp(file.path) && !is_cmake(file.path)) return {};
  const std::size_t expected = script ? 1 : 0;
  if (lines.size() > expected && lines[expected] == licence_comment(file.path)) return {};
  return {{file.path, static_cast<int>(expected) + 1,
           "must read " + std::string(licence_comment(file.path))}};
}

std::vector<Violation> oversized(const SourceFile& file) {
  if (!is_cpp(file.path)) return {};
  std::vector<Violation> violations;
  const std::size_t lines = lines_of(file.text).size();
  if (lines > kMostLinesOfFile) {
    violations.push_back({file.path, 0, "has " + std::to_string(lines) + " lines, 500 at most"});
  }
  for (const FunctionLength& function : function_lengths(file.text)) {
    if (function.lines <= kMostLinesOfFunction) continue;
    violations.push_back(
        {file.path, function.first_line,
         "a function of " + std::to_string(function.lines) + " lines, 60 at most"});
  }
  return violations;
}

std::vector<Violation> unguarded_header(const SourceFile& file) {
  const bool guarded = file.text.find("\n#pragma once\n") != std::string::npos;
  if (!file.path.ends_with(".h") || guarded) return {};
  return {{file.path, 0, "has no #pragma once"}};
}

std::vector<Violation> leftovers(const SourceFile& file) {
  std::vector<Violation> violations;
  const std::vector<std::string_view> lines = lines_of(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const Leftover& kind : leftover_kinds()) {
      std::match_results<std::string_view::const_iterator> match;
      if (!std::regex_search(lines[i].begin(), lines[i].end(), match, kind.pattern)) continue;
      violations.push_back(
          {file.path, static_cast<int>(i) + 1, "says " + match.str() + ": " + kind.sentence});
    }
  }
  return violations;
}

}  // namespace plumbline::architecture
