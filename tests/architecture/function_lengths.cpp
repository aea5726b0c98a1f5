// SPDX-License-Identifier: MIT
#include "tests/architecture/function_lengths.h"

#include <cstddef>
#include <regex>
#include <string>

#include "tests/architecture/source_text.h"

namespace plumbline::architecture {

namespace {

enum class Scope { kOpen, kFunction, kOther };  // kOpen: a namespace or class, looked into

// Preprocessor lines are blanked: their braces need not pair.
std::string without_directives(std::string code) {
  bool continued = false;
  for (std::size_t at = 0; at < code.size();) {
    std::size_t end = code.find('\n', at);
    if (end == std::string::npos) end = code.size();
    const std::size_t first = code.find_first_not_of(" \t", at);
    const bool directive = continued || (first < end && code[first] == '#');
    continued = directive && end > at && code[end - 1] == '\\';
    if (directive) code.replace(at, end - at, end - at, ' ');
    at = end + 1;
  }
  return code;
}

// What the text before an opening brace, since the last ; { or }, makes of it.
Scope scope_after(const std::string& head) {
  static const std::regex holder(R"(^\s*(inline\s+)?(namespace|extern)\b)");
  static const std::regex type(R"(^\s*(template\s*<.*>\s*)?(class|struct|union)\b[^()]*$)");
  if (std::regex_search(head, holder) || std::regex_search(head, type)) return Scope::kOpen;
  const std::size_t call = head.find('(');
  const std::size_t value = head.find('=');
  const bool initialiser = value < call && head.find("operator") == std::string::npos;
  return call == std::string::npos || initialiser ? Scope::kOther : Scope::kFunction;
}

// Attributes and alignments carry brackets that are no parameters.
std::string without_attributes(const std::string& head) {
  static const std::regex attribute(R"(\[\[[^\]]*\]\]|alignas\([^)]*\)|[\n])");
  return std::regex_replace(head, attribute, " ");
}

class Reader {
 public:
  explicit Reader(std::string code) : code_(std::move(code)) {}

  std::vector<FunctionLength> read() {
    for (at_ = 0; at_ < code_.size(); ++at_) {
      const char c = code_[at_];
      if (c == '\n') ++line_;
      if (c == '{') {
        open();
      } else if (c == '}' || c == ';') {
        head_.clear();
      } else {
        head_ += c;
      }
    }
    return std::move(found_);
  }

 private:
  void open() {
    const Scope scope = scope_after(without_attributes(head_));
    head_.clear();
    if (scope == Scope::kOpen) return;
    const int first_line = line_;
    skip_to_closing();
    if (scope == Scope::kFunction) found_.push_back({first_line, line_ - first_line + 1});
  }

  void skip_to_closing() {
    int depth = 0;
    for (; at_ < code_.size(); ++at_) {
      if (code_[at_] == '\n') ++line_;
      if (code_[at_] == '{') ++depth;
      if (code_[at_] == '}' && --depth == 0) return;
    }
  }

  std::string code_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::string head_;
  std::vector<FunctionLength> found_;
};

}  // namespace

std::vector<FunctionLength> function_lengths(std::string_view text) {
  return Reader(without_directives(code_only(text))).read();
}

}  // namespace plumbline::architecture
