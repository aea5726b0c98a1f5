// SPDX-License-Identifier: MIT
#include "tests/fuzz/config_properties.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "firmware/config/agreement.h"
#include "firmware/config/config_text.h"
#include "firmware/config/config_toml.h"
#include "firmware/config/key.h"

namespace plumbline::fuzz {
namespace {

using config::Config;
using config::ConfigReading;

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

void require_ranges(const Config& config) {
  for (const config::Key& key : config::keys()) {
    Config copy = config;
    require(key.put(copy, key.get(config)), "every value is one that its key takes");
    require(key.get(copy) == key.get(config), "a value that is put back is the same");
  }
}

void require_agreement(const Config& config) {
  Config copy = config;
  require(config::settle(copy).empty(), "what disagreed has been settled");
  const std::vector<double>& heights = config.capture.plan.heights_m;
  require(!heights.empty() && heights.size() <= config::kMostHeights, "there are heights");
  require(std::ranges::adjacent_find(heights, std::greater_equal<>()) == heights.end(),
          "heights ascend");
  require(copy.capture.plan.heights_m == heights, "heights are those that the keys say");
}

void require_round_trip(const Config& config) {
  const ConfigReading again = config::parse_config(config::config_text(config), "again");
  require(again.errors.empty(), "its own text is good");
  for (const config::Key& key : config::keys()) {
    require(key.get(again.config) == key.get(config), "its own text says the same");
  }
}

void require_sentence(const std::string& sentence, std::size_t lines) {
  constexpr std::string_view kName = "name:";
  require(sentence.starts_with(kName), "an error names the file");
  std::size_t line = 0;
  const char* end = sentence.data() + sentence.size();
  const auto read = std::from_chars(sentence.data() + kName.size(), end, line);
  require(read.ec == std::errc{} && std::string_view(read.ptr, end).starts_with(": "),
          "an error names a line");
  require(line >= 1 && line <= lines, "the line is one of the file");
  require(std::ranges::none_of(
              sentence, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }),
          "an error is one line");
}

}  // namespace

void check_config(const std::string& text) {
  const ConfigReading reading = config::parse_config(text, "name");
  require_ranges(reading.config);
  require_agreement(reading.config);
  require_round_trip(reading.config);
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
  for (const Error& error : reading.errors) require_sentence(error.sentence, lines);
}

}  // namespace plumbline::fuzz
