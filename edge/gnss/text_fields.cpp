// SPDX-License-Identifier: MIT
#include "edge/gnss/text_fields.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace plumbline::gnss {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

// Digits with at most one point, and at least one digit.
bool is_unsigned_decimal(std::string_view text) {
  const auto points = std::count(text.begin(), text.end(), '.');
  const auto digits = std::count_if(text.begin(), text.end(), is_digit);
  return digits > 0 && points <= 1 && static_cast<std::size_t>(digits + points) == text.size();
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view separators,
                                    bool skip_empty) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = text.find_first_of(separators);
    const std::string_view field = text.substr(0, end);
    if (!field.empty() || !skip_empty) fields.push_back(field);
    if (end == std::string_view::npos) return fields;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> decimal(std::string_view field) {
  constexpr std::size_t kLongest = 24;
  const bool negative = field.starts_with('-');
  const std::string_view unsigned_part = field.substr(negative ? 1 : 0);
  if (field.size() > kLongest || !is_unsigned_decimal(unsigned_part)) return std::nullopt;
  double value = 0;
  const auto [end, fault] =
      std::from_chars(field.data(), field.data() + field.size(), value, std::chars_format::fixed);
  if (fault != std::errc{} || end != field.data() + field.size()) return std::nullopt;
  return value;
}

std::optional<int> whole_number(std::string_view field) {
  constexpr std::size_t kLongest = 9;
  if (field.size() > kLongest || !all_digits(field)) return std::nullopt;
  int value = 0;
  std::from_chars(field.data(), field.data() + field.size(), value);
  return value;
}

std::optional<std::chrono::microseconds> seconds(std::string_view field) {
  const std::size_t point = field.find('.');
  const auto whole = whole_number(field.substr(0, point));
  if (!whole || !is_unsigned_decimal(field)) return std::nullopt;
  std::int64_t microseconds = 0;
  std::int64_t unit = 1'000'000;
  const std::string_view fraction =
      point == std::string_view::npos ? std::string_view{} : field.substr(point + 1);
  for (std::size_t i = 0; i < fraction.size() && i < 7; ++i) {
    const std::int64_t digit = fraction[i] - '0';
    if (i == 6) microseconds += digit >= 5 ? 1 : 0;
    unit /= 10;
    microseconds += digit * unit;
  }
  return std::chrono::microseconds(*whole * std::int64_t{1'000'000} + microseconds);
}

std::optional<std::chrono::microseconds> time_of_day(std::string_view field) {
  if (field.size() < 6 || !all_digits(field.substr(0, 6))) return std::nullopt;
  if (field.size() > 6 && field[6] != '.') return std::nullopt;
  const auto hours = *whole_number(field.substr(0, 2));
  const auto minutes = *whole_number(field.substr(2, 2));
  const auto rest = seconds(field.substr(4));
  if (hours > 23 || minutes > 59 || !rest || *rest >= std::chrono::seconds(61)) return std::nullopt;
  return std::chrono::hours(hours) + std::chrono::minutes(minutes) + *rest;
}

std::optional<double> degrees_and_minutes(std::string_view field, std::size_t degree_digits,
                                          double max_deg) {
  const std::size_t whole_digits = std::min(field.find('.'), field.size());
  if (whole_digits != degree_digits + 2) return std::nullopt;
  const auto degrees = whole_number(field.substr(0, degree_digits));
  const auto minutes = decimal(field.substr(degree_digits));
  if (!degrees || !minutes || *minutes < 0 || *minutes >= 60) return std::nullopt;
  const double value_deg = *degrees + *minutes / 60.0;
  if (value_deg > max_deg) return std::nullopt;
  return value_deg;
}

}  // namespace plumbline::gnss
