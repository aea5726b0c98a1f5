// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::architecture {

// A file of the project: its path from the repository's root, with '/', and what is in it.
struct SourceFile {
  std::string path;
  std::string text;
};

// A rule broken, as a sentence that begins with `path:line:`.
struct Violation {
  std::string path;
  int line = 0;  // 1-based; 0: the file as a whole
  std::string sentence;
};
std::ostream& operator<<(std::ostream& out, const Violation& violation);

// The text with comments and the insides of string and character literals (raw ones too) replaced
// by blanks; every line keeps its number and every character its place.
std::string code_only(std::string_view text);

// The lines, without their ends. A last line without an end counts.
std::vector<std::string_view> lines_of(std::string_view text);

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& prefixes);

}  // namespace plumbline::architecture
