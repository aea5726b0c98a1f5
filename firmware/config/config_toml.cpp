// SPDX-License-Identifier: MIT
#include "firmware/config/config_toml.h"

// toml++ 3.3 asserts of a section's name, or has clang assume, what it checks just after: "[)"
// would end the program, or be undefined. With this the check counts.
#undef NDEBUG
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "firmware/config/agreement.h"
#include "firmware/config/guard.h"
#include "firmware/config/key.h"
#include "firmware/config/nearest.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::config {
namespace {

constexpr const char* kListed = "plumbline config --example lists them all.";

std::optional<std::vector<double>> numbers_in(const toml::array& list) {
  std::vector<double> numbers;
  for (const toml::node& entry : list) {
    const auto number = entry.is_number() ? entry.value<double>() : std::nullopt;
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

Value value_of(const toml::node& node) {
  if (node.is_boolean()) return *node.value<bool>();
  if (node.is_string()) return *node.value<std::string>();
  if (node.is_number()) {
    const auto number = node.value<double>();
    return number ? Value(*number) : Value();
  }
  const toml::array* list = node.as_array();
  auto numbers = list ? numbers_in(*list) : std::nullopt;
  return numbers ? Value(*std::move(numbers)) : Value();
}

std::string in_brackets(std::string_view section) { return "[" + std::string(section) + "]"; }

std::string did_you_mean(const std::optional<std::string>& suggestion) {
  return suggestion ? "; did you mean " + *suggestion + "?" : std::string("; ") + kListed;
}

std::vector<std::string_view> names_in(std::string_view section) {
  std::vector<std::string_view> names;
  for (const Key& key : keys()) {
    if (key.section == section) names.push_back(key.name);
  }
  return names;
}

// The sections that have a key of this name: "[advice]", "[take_off] or [release]".
std::string homes_of(std::string_view name) {
  std::string homes;
  for (const Key& key : keys()) {
    if (key.name == name) homes += (homes.empty() ? "" : " or ") + in_brackets(key.section);
  }
  return homes;
}

std::string unknown_key(std::string_view section, std::string_view name) {
  const std::string what = ingest::in_quotes(shown(name)) + " is no key of " + in_brackets(section);
  const auto near = nearest(name, names_in(section));
  if (!near && !homes_of(name).empty()) return what + "; put it under " + homes_of(name) + ".";
  return what + did_you_mean(near ? std::optional(ingest::in_quotes(*near)) : std::nullopt);
}

std::string unknown_section(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Section& section : sections()) known.push_back(section.name);
  const auto near = nearest(name, known);
  return in_brackets(shown(name)) + " is no section" +
         did_you_mean(near ? std::optional(in_brackets(*near)) : std::nullopt);
}

std::string outside(std::string_view name) {
  const std::string homes = homes_of(name);
  return ingest::in_quotes(shown(name)) + " stands outside of any section; " +
         (homes.empty() ? kListed : "put it under " + homes + ".");
}

bool is_section(std::string_view name) {
  return std::ranges::any_of(sections(), [&](const Section& s) { return s.name == name; });
}

class Reader {
 public:
  explicit Reader(std::string name) : name_(std::move(name)) {}

  ConfigReading read(const toml::table& file) {
    for (const auto& [key, node] : file) read_top(key, node);
    for (const Disagreement& one : settle(reading_.config)) {
      fail(line_of(one), one.sentence);
    }
    return finished();
  }

  // Nothing of it can be used.
  ConfigReading refuse(std::size_t line, const std::string& sentence) {
    fail(line, sentence);
    return finished();
  }

 private:
  void fail(std::size_t line, const std::string& sentence) {
    errors_.emplace(line, Error{ingest::at_line(name_, line) + sentence});
  }

  ConfigReading finished() {
    for (auto& [line, error] : errors_) reading_.errors.push_back(std::move(error));
    return std::move(reading_);
  }

  void read_top(const toml::key& key, const toml::node& node) {
    const std::size_t line = key.source().begin.line;
    const std::string_view name = key.str();
    const toml::table* table = node.as_table();
    if (!is_section(name)) return fail(line, table ? unknown_section(name) : outside(name));
    if (!table)
      return fail(line, std::string(name) + " is a section; write " + in_brackets(name) +
                            " in a line of its own, and its keys below.");
    for (const auto& [inner, value] : *table) read_key(name, inner, value);
  }

  void read_key(std::string_view section, const toml::key& name, const toml::node& node) {
    const std::size_t line = name.source().begin.line;
    const Key* key = find_key(section, name.str());
    if (key == nullptr) return fail(line, unknown_key(section, name.str()));
    const Value value = value_of(node);
    if (!key->put(reading_.config, value)) {
      return fail(line, std::string(key->name) + " wants " + key->wants + ", not " +
                            shown(toml_of(value)) + ".");
    }
    lines_[{key->section, key->name}] = line;
  }

  // Of the first of its keys that the file gives a value.
  std::size_t line_of(const Disagreement& one) const {
    for (const auto& [section, key] : one.between) {
      const auto line = lines_.find({section, key});
      if (line != lines_.end()) return line->second;
    }
    return 1;
  }

  std::string name_;
  ConfigReading reading_;
  std::multimap<std::size_t, Error> errors_;
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> lines_;
};

}  // namespace

ConfigReading parse_config(const std::string& text, const std::string& name) {
  Reader reader(name);
  if (const auto stray = stray_in(text)) return reader.refuse(stray->line, stray->sentence);
  try {
    return reader.read(toml::parse(text, name));
  } catch (const toml::parse_error& error) {
    return reader.refuse(error.source().begin.line,
                         "not valid TOML (" + shown(error.description()) + ").");
  }
}

Result<ConfigReading> read_config(const std::filesystem::path& path) {
  const Result<std::string> text = ingest::read_text_file(path, 1u << 20);
  if (!text) return text.error();
  return parse_config(*text, path.filename().string());
}

}  // namespace plumbline::config
