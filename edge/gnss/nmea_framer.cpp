// SPDX-License-Identifier: MIT
#include "edge/gnss/nmea_framer.h"

#include <optional>

namespace plumbline::gnss {
namespace {

// NMEA allows 82 characters; high-precision and proprietary sentences run to twice that.
constexpr std::size_t kLongestSentence = 255;

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  return std::nullopt;
}

bool checksum_holds(std::string_view body, char high, char low) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  const auto h = hex_digit(high);
  const auto l = hex_digit(low);
  return h && l && sum == *h * 16 + *l;
}

}  // namespace

void NmeaFramer::feed(std::string_view bytes) {
  counters_.bytes += bytes.size();
  for (const char c : bytes) take(c);
}

void NmeaFramer::finish() {
  if (inside_) end_sentence();
}

void NmeaFramer::take(char c) {
  const bool line_ends = c == '\r' || c == '\n' || c == '$';
  if (inside_ && line_ends) end_sentence();
  if (c == '$') {
    inside_ = true;
    sentence_.clear();
    return;
  }
  if (!inside_) return;
  if (!is_printable(c) || sentence_.size() >= kLongestSentence) {
    abandon();
    return;
  }
  sentence_.push_back(c);
}

void NmeaFramer::end_sentence() {
  const std::size_t star = sentence_.find('*');
  if (star == std::string::npos || star + 3 != sentence_.size()) {
    abandon();
    return;
  }
  inside_ = false;
  const std::string_view body = std::string_view(sentence_).substr(0, star);
  if (!checksum_holds(body, sentence_[star + 1], sentence_[star + 2])) {
    ++counters_.bad_checksum;
  } else if (sink_(body)) {
    ++counters_.sentences;
  } else {
    ++counters_.malformed;
  }
}

void NmeaFramer::abandon() {
  inside_ = false;
  const bool began_like_a_sentence =
      sentence_.size() >= 2 && is_capital(sentence_[0]) && is_capital(sentence_[1]);
  if (began_like_a_sentence) ++counters_.malformed;
}

}  // namespace plumbline::gnss
