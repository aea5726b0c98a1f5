// SPDX-License-Identifier: MIT
#include "firmware/config/value.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "firmware/ingest/number.h"

namespace plumbline::config {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string escaped(char c) {
  if (c == '"' || c == '\\') return {'\\', c};
  if (!is_control(c)) return {c};
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "\\u%04x", static_cast<unsigned>(c));
  return text.data();
}

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += escaped(c);
  return quoted + '"';
}

std::string listed(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers) {
    list += (list.empty() ? "" : ", ") + figures(number);
  }
  return "[" + list + "]";
}

}  // namespace

std::string figures(double number) {
  const double size = std::abs(number);
  if (number != 0 && !(size >= 1e-4 && size < 1e15)) return ingest::shortest(number);
  std::array<char, 40> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  return {text.data(), end};
}

std::string toml_of(const Value& value) {
  if (const bool* yes = std::get_if<bool>(&value)) return *yes ? "true" : "false";
  if (const double* number = std::get_if<double>(&value)) return figures(*number);
  if (const std::string* text = std::get_if<std::string>(&value)) return quoted(*text);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return listed(*numbers);
  return "something else";
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string line(text.substr(0, kMost));
  if (text.size() > kMost) {
    // Not in the middle of a character of several bytes.
    while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xc0) == 0x80) {
      line.pop_back();
    }
    if (!line.empty() && static_cast<unsigned char>(line.back()) >= 0x80) line.pop_back();
    line += "...";
  }
  for (char& c : line) {
    if (is_control(c)) c = '?';
  }
  return line;
}

}  // namespace plumbline::config
