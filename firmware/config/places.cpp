// SPDX-License-Identifier: MIT
#include "firmware/config/places.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace plumbline::config {
namespace {

constexpr std::size_t kMostNameBytes = 200;
constexpr std::size_t kMostSocketBytes = 107;

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  return read.ec == std::errc{} && read.ptr == end ? std::optional(value) : std::nullopt;
}

bool is_whole_number(std::string_view text, int low, int high) {
  const auto value = whole_number(text);
  return value && *value >= low && *value <= high;
}

bool is_visible(char c) { return static_cast<unsigned char>(c) > 0x20 && c != 0x7f; }

bool is_host_and_port(std::string_view text, std::string_view scheme) {
  if (!text.starts_with(scheme)) return false;
  text.remove_prefix(scheme.size());
  const std::size_t colon = text.rfind(':');
  return colon != std::string_view::npos && colon > 0 && std::ranges::all_of(text, is_visible) &&
         is_whole_number(text.substr(colon + 1), 1, 65535);
}

bool is_path(std::string_view text) {
  return text.size() > 1 && text.starts_with('/') && !text.ends_with('/');
}

bool is_serial_port(std::string_view text) {
  const std::size_t at = text.find('@');
  if (!is_path(text.substr(0, at))) return false;
  return at == std::string_view::npos || is_whole_number(text.substr(at + 1), 50, 4'000'000);
}

bool is_gpio_line(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return !text.empty() && !text.starts_with('/');
  return colon > 0 && is_whole_number(text.substr(colon + 1), 0, 9999);
}

}  // namespace

bool is_text(const std::string& text) {
  return text.size() <= kMostNameBytes && std::ranges::none_of(text, [](char c) {
           return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
         });
}

bool is_absolute_path(const std::string& text) { return is_text(text) && is_path(text); }

bool is_absolute_path_or_empty(const std::string& text) {
  return text.empty() || is_absolute_path(text);
}

bool is_socket_path(const std::string& text) {
  return is_absolute_path(text) && text.size() <= kMostSocketBytes;
}

bool is_receiver_address(const std::string& text) {
  return is_text(text) && (is_host_and_port(text, "tcp://") || is_serial_port(text));
}

bool is_gpio_line_or_empty(const std::string& text) {
  return text.empty() || (is_text(text) && is_gpio_line(text));
}

bool is_pps_or_empty(const std::string& text) {
  constexpr std::string_view kGpio = "gpio:";
  if (text.starts_with(kGpio)) return is_text(text) && is_gpio_line(text.substr(kGpio.size()));
  return is_absolute_path_or_empty(text);
}

bool is_pilot_link_or_empty(const std::string& text) {
  if (text.empty()) return true;
  return is_text(text) && (is_host_and_port(text, "udp://") || is_serial_port(text));
}

}  // namespace plumbline::config
