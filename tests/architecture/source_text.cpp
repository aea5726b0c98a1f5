// SPDX-License-Identifier: MIT
#include "tests/architecture/source_text.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace plumbline::architecture {

namespace {

constexpr std::size_t kNone = std::string_view::npos;

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Where the literal or comment that begins at `at` ends (one past it); `at` where none begins.
class Skipper {
 public:
  explicit Skipper(std::string_view text) : text_(text) {}

  std::size_t end_of_comment(std::size_t at) const {
    if (text_.substr(at, 2) == "//") return until("\n", at, 0);
    if (text_.substr(at, 2) == "/*") return until("*/", at + 2, 2);
    return at;
  }

  std::size_t end_of_literal(std::size_t at) const {
    if (text_[at] == '"') return is_raw(at) ? end_of_raw(at) : end_of_quoted(at);
    // 1'000: a digit separator, not a character.
    const bool separator = at > 0 && is_word(text_[at - 1]);
    if (text_[at] == '\'' && !separator) return end_of_quoted(at);
    return at;
  }

 private:
  std::size_t until(std::string_view mark, std::size_t from, std::size_t beyond) const {
    const std::size_t found = text_.find(mark, from);
    return found == kNone ? text_.size() : found + beyond;
  }

  bool is_raw(std::size_t quote) const { return quote > 0 && text_[quote - 1] == 'R'; }

  std::size_t end_of_raw(std::size_t quote) const {
    const std::size_t open = text_.find('(', quote);
    if (open == kNone) return text_.size();
    const std::string delimiter{text_.substr(quote + 1, open - quote - 1)};
    const std::string close = ")" + delimiter + "\"";
    return until(close, open, close.size());
  }

  std::size_t end_of_quoted(std::size_t quote) const {
    for (std::size_t i = quote + 1; i < text_.size() && text_[i] != '\n'; ++i) {
      if (text_[i] == '\\') {
        ++i;
      } else if (text_[i] == text_[quote]) {
        return i + 1;
      }
    }
    return text_.size();
  }

  std::string_view text_;
};

void blank(std::string& text, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Violation& violation) {
  return out << violation.path << ':' << violation.line << ": " << violation.sentence;
}

std::string code_only(std::string_view text) {
  std::string code{text};
  const Skipper skipper(text);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t after_comment = skipper.end_of_comment(at);
    const std::size_t after_literal = skipper.end_of_literal(at);
    if (after_comment > at) {
      blank(code, at, after_comment);
    } else if (after_literal > at + 1) {
      blank(code, at + 1, after_literal - 1);
    }
    at = std::max({at + 1, after_comment, after_literal});
  }
  return code;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text = end == kNone ? std::string_view{} : text.substr(end + 1);
  }
  return lines;
}

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](std::string_view prefix) { return text.starts_with(prefix); });
}

}  // namespace plumbline::architecture
