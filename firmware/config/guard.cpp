// SPDX-License-Identifier: MIT
#include "firmware/config/guard.h"

#include <algorithm>

namespace plumbline::config {
namespace {

constexpr std::size_t kMostFileBytes = 64u << 10;
constexpr int kMostDots = 1'000;  // each may be a table in a table

// Behind the text in quotes that begins at `at`, or at the end of its line.
std::size_t behind_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at++];
  while (at < text.size() && text[at] != quote && text[at] != '\n') {
    at += text[at] == '\\' && quote == '"' && at + 1 < text.size() && text[at + 1] != '\n' ? 2 : 1;
  }
  return at < text.size() && text[at] == quote ? at + 1 : at;
}

// Behind the comment or the text in quotes that begins at `at`, else one further.
std::size_t next(std::string_view text, std::size_t at) {
  if (text[at] == '#') return std::min(text.find('\n', at), text.size());
  return text[at] == '"' || text[at] == '\'' ? behind_quotes(text, at) : at + 1;
}

Stray too_large() {
  return {1,
          "this is far too large for a configuration of Plumbline; plumbline config --example "
          "prints one."};
}

}  // namespace

std::optional<Stray> stray_in(std::string_view text) {
  if (text.size() > kMostFileBytes) return too_large();
  int dots = 0;
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); at = next(text, at)) {
    const std::string_view rest = text.substr(at);
    if (static_cast<unsigned char>(rest[0]) >= 0x80) {
      return Stray{line, "a character that is not ASCII stands outside of quotes; remove it."};
    }
    if (rest.starts_with("\"\"\"") || rest.starts_with("'''")) {
      return Stray{line, "no key wants text over several lines; write it in one pair of quotes."};
    }
    if (rest[0] == '\n') ++line;
    if (rest[0] == '.' && ++dots > kMostDots) return too_large();
  }
  return std::nullopt;
}

}  // namespace plumbline::config
