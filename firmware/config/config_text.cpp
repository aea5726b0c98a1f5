// SPDX-License-Identifier: MIT
#include "firmware/config/config_text.h"

#include <sstream>
#include <string_view>

#include "firmware/config/key.h"

namespace plumbline::config {
namespace {

constexpr std::size_t kWidth = 100;

// Lines of comment, broken between words.
std::string comment(const std::string& sentence) {
  std::istringstream words(sentence);
  std::string lines;
  std::string line = "#";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kWidth) {
      lines += line + '\n';
      line = "#";
    }
    line += ' ' + word;
  }
  return lines + line + '\n';
}

std::string assignment(const Key& key, const Config& config) {
  return std::string(key.name) + " = " + toml_of(key.get(config)) + '\n';
}

std::string explained(const Key& key) {
  return comment(std::string(key.sentence)) + comment("It wants " + key.wants + ".") + '#' +
         assignment(key, Config());
}

}  // namespace

std::string config_example() {
  std::string text =
      "# SPDX-License-Identifier: MIT\n" +
      comment(
          "The configuration of plumblined, as a rule /etc/plumbline/plumbline.toml. Every key "
          "may be left out; the value shown is its default. Remove the # in front of a key to "
          "change it, and try the file with: plumbline config --check FILE");
  for (const Section& section : sections()) {
    text += "\n[" + std::string(section.name) + "]\n" + comment(std::string(section.sentence));
    for (const Key& key : keys()) {
      if (key.section == section.name) text += '\n' + explained(key);
    }
  }
  return text;
}

std::string config_text(const Config& config) {
  std::string text;
  for (const Section& section : sections()) {
    text += (text.empty() ? "[" : "\n[") + std::string(section.name) + "]\n";
    for (const Key& key : keys()) {
      if (key.section == section.name) text += assignment(key, config);
    }
  }
  return text;
}

}  // namespace plumbline::config
