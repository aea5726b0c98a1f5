// SPDX-License-Identifier: MIT
// The example that users start from, and that documents every key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "firmware/config/config_text.h"
#include "firmware/config/config_toml.h"
#include "firmware/config/key.h"

namespace plumbline::config {
namespace {

std::string file_text() {
  std::ifstream in(PLUMBLINE_SOURCE_DIR "/firmware/config/plumbline_example.toml");
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string without_comment_marks(const std::string& text) {
  return std::regex_replace(text, std::regex("(^|\n)#([a-z])"), "$1$2");
}

void expect_defaults(const ConfigReading& reading) {
  const Config usual;
  EXPECT_THAT(reading.errors, testing::IsEmpty());
  for (const Key& key : keys()) {
    EXPECT_EQ(key.get(reading.config), key.get(usual)) << key.section << '.' << key.name;
  }
}

TEST(ConfigExample, TheFileIsWhatTheTableOfKeysSays) { EXPECT_EQ(file_text(), config_example()); }

TEST(ConfigExample, SaysNothingAsItIs) { expect_defaults(parse_config(file_text(), "example")); }

TEST(ConfigExample, SaysTheDefaultsWithoutItsCommentMarks) {
  expect_defaults(parse_config(without_comment_marks(file_text()), "example"));
}

// Two keys of one name in a section, or a line that is taken for a comment, would be fewer.
TEST(ConfigExample, HoldsEveryKeyOnce) {
  std::istringstream lines(file_text());
  std::multiset<std::string> found;
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) section = line;
    const bool is_key = line.size() > 1 && line[0] == '#' && line[1] != ' ';
    if (is_key) found.insert(section + line.substr(1, line.find(' ') - 1));
  }
  std::multiset<std::string> known;
  for (const Key& key : keys()) {
    known.insert("[" + std::string(key.section) + "]" + std::string(key.name));
  }
  EXPECT_EQ(found, known);
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()).size(), found.size());
}

TEST(ConfigExample, EveryKeyHasASectionAndEverySectionAKey) {
  std::set<std::string_view> with_keys;
  for (const Key& key : keys()) with_keys.insert(key.section);
  std::set<std::string_view> known;
  for (const Section& section : sections()) known.insert(section.name);
  EXPECT_EQ(with_keys, known);
}

// A table whose setters and getters were mixed up would put a value elsewhere.
TEST(ConfigKeys, EachChangesItsOwnValueAlone) {
  for (const Key& key : keys()) {
    const Config usual;
    for (const Value& value : {Value(true), Value(false), Value(1.0), Value(7.0), Value(60.0),
                               Value(150.0), Value(std::string("/a/b")), Value(std::string("down")),
                               Value(std::string("pulse")), Value(std::string("pilot")),
                               Value(std::string("request")), Value(std::vector<double>{1, 2})}) {
      Config changed;
      if (!key.put(changed, value)) continue;
      EXPECT_EQ(key.get(changed), value) << key.name;
      for (const Key& other : keys()) {
        if (&other == &key) continue;
        EXPECT_EQ(other.get(changed), other.get(usual)) << key.name << " moved " << other.name;
      }
    }
  }
}

TEST(ConfigKeys, AUnitIsInTheNameOfWhateverHasOne) {
  const std::vector<std::pair<std::string, std::string>> units = {
      {"_m", "metres"},        {"_m_s", "metres per second"}, {"_s", "seconds"},
      {"_ms", "milliseconds"}, {"_us", "microseconds"},       {"_px", "pixels"},
      {"_mb", "megabytes"},    {"_dioptre", "dioptres"},      {"_per_s", "frames per second"}};
  for (const Key& key : keys()) {
    for (const auto& [suffix, unit] : units) {
      if (key.wants.find("number of " + unit + " from") == std::string::npos) continue;
      EXPECT_TRUE(key.name.ends_with(suffix) || key.name == unit) << key.name;
    }
  }
}

}  // namespace
}  // namespace plumbline::config
