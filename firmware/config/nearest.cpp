// SPDX-License-Identifier: MIT
#include "firmware/config/nearest.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>

namespace plumbline::config {
namespace {

char small(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool same(char a, char b) { return small(a) == small(b); }

// Optimal string alignment (Damerau 1964, each place edited once), row by row.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({change, last[j] + 1, row[j - 1] + 1});
      const bool exchanged = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, std::move(row));
  }
  return last[b.size()];
}

bool begins(std::string_view word, std::string_view known) {
  constexpr std::size_t kTelling = 3;
  return word.size() >= kTelling && known.starts_with(word);
}

}  // namespace

std::optional<std::string_view> nearest(std::string_view word,
                                        const std::vector<std::string_view>& known) {
  const std::size_t most = std::max<std::size_t>(1, word.size() / 3);
  std::size_t least = most + 1;
  std::optional<std::string_view> found;
  std::optional<std::string_view> longer;
  for (const std::string_view candidate : known) {
    if (!longer && begins(word, candidate)) longer = candidate;
    if (word.size() > 2 * candidate.size()) continue;
    const std::size_t changes = distance(word, candidate);
    if (changes >= least) continue;
    least = changes;
    found = candidate;
  }
  return found ? found : longer;
}

}  // namespace plumbline::config
