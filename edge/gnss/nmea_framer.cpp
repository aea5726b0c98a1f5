// SPDX-License-Identifier: MIT
#include "edge/gnss/nmea_framer.h"

#include <algorithm>
#include <array>
#include <optional>

namespace plumbline::gnss {
namespace {

// NMEA allows 82 characters; high-precision and proprietary sentences run to twice that.
constexpr std::size_t kLongestSentence = 255;

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

// Whether a byte goes on with the sentence that it stands in.
constexpr std::array<bool, 256> kGoesOn = [] {
  std::array<bool, 256> goes_on{};
  for (std::size_t c = ' '; c <= '~'; ++c) goes_on[c] = c != '$';
  return goes_on;
}();

// How many of the first `most` bytes go on with a sentence.
std::size_t run_length(std::string_view bytes, std::size_t most) {
  const std::size_t end = std::min(bytes.size(), most);
  std::size_t length = 0;
  while (length < end && kGoesOn[static_cast<unsigned char>(bytes[length])]) ++length;
  return length;
}

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
  const std::uint64_t before = counters_.bytes;
  counters_.bytes += bytes.size();
  std::string_view rest = bytes;
  while (!rest.empty()) {
    if (!inside_) {
      const std::size_t dollar = rest.find('$');
      if (dollar == std::string_view::npos) return;
      rest.remove_prefix(dollar + 1);
      inside_ = true;
      begin_ = before + (bytes.size() - rest.size()) - 1;
    }
    rest.remove_prefix(take(rest));
  }
}

void NmeaFramer::finish() {
  if (inside_) end_sentence(kept_);
  leave();
}

// Goes on with the sentence; returns how many bytes were of it. The byte that ended it is left: it
// may be the '$' of the next.
std::size_t NmeaFramer::take(std::string_view bytes) {
  const std::size_t room = kLongestSentence - kept_.size();
  const std::size_t length = run_length(bytes, room + 1);
  const bool ended = length <= room && length < bytes.size();
  std::string_view sentence = bytes.substr(0, length);
  if (!ended || !kept_.empty()) sentence = kept_.append(sentence);
  if (ended) {
    const char end = bytes[length];
    const bool line_ends = end == '\r' || end == '\n' || end == '$';
    line_ends ? end_sentence(sentence) : abandon(sentence);
    leave();
  } else if (length > room) {
    abandon(sentence);
    leave();
  }
  return length;
}

void NmeaFramer::end_sentence(std::string_view sentence) {
  const std::size_t star = sentence.find('*');
  if (star == std::string_view::npos || star + 3 != sentence.size()) {
    abandon(sentence);
    return;
  }
  const std::string_view body = sentence.substr(0, star);
  sentence_bytes_ = {begin_, begin_ + 1 + sentence.size()};
  if (!checksum_holds(body, sentence[star + 1], sentence[star + 2])) {
    ++counters_.bad_checksum;
  } else {
    end_good(body);
  }
}

void NmeaFramer::end_good(std::string_view body) {
  if (sink_(body)) {
    ++counters_.sentences;
  } else {
    ++counters_.malformed;
  }
}

void NmeaFramer::abandon(std::string_view sentence) {
  const bool began_like_a_sentence =
      sentence.size() >= 2 && is_capital(sentence[0]) && is_capital(sentence[1]);
  if (began_like_a_sentence) ++counters_.malformed;
}

void NmeaFramer::leave() {
  inside_ = false;
  kept_.clear();
}

}  // namespace plumbline::gnss
