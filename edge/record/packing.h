// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace plumbline::record {

// Figures to bytes, little-endian, without padding: record_format.md.
class Packer {
 public:
  // Appends to `out`, which outlives it.
  explicit Packer(std::string& out) : out_(out) {}

  template <std::integral T>
  void put(T value) {
    auto bits = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t k = 0; k < sizeof(T); ++k) {
      out_.push_back(static_cast<char>(bits & 0xFF));
      if constexpr (sizeof(T) > 1) bits = static_cast<decltype(bits)>(bits >> 8);
    }
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  void put(std::chrono::nanoseconds value) { put(static_cast<std::int64_t>(value.count())); }
  template <typename Clock>
  void put(std::chrono::time_point<Clock, std::chrono::nanoseconds> time) {
    put(std::chrono::nanoseconds(time.time_since_epoch()));
  }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    out_.append(text);
  }

 private:
  std::string& out_;
};

// And back. After the first that does not fit, good() is false and everything read is zero.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  bool good() const { return good_; }
  bool at_end() const { return bytes_.empty(); }

  template <typename T>
  T get() {
    if constexpr (std::is_same_v<T, bool>) {
      const auto byte = get<std::uint8_t>();
      if (byte > 1) good_ = false;
      return byte == 1;
    } else if constexpr (std::is_same_v<T, double>) {
      return std::bit_cast<double>(get<std::uint64_t>());
    } else if constexpr (std::is_same_v<T, std::chrono::nanoseconds>) {
      return std::chrono::nanoseconds(get<std::int64_t>());
    } else if constexpr (std::is_same_v<T, std::string>) {
      return std::string(take(get<std::uint32_t>()));
    } else {
      static_assert(std::integral<T>);
      return integer<T>();
    }
  }
  template <typename Time>
  Time get_time() {
    return Time(get<std::chrono::nanoseconds>());
  }
  // A number that names one of `count` cases.
  template <typename Enum>
  Enum get_case(int count) {
    const auto number = get<std::uint8_t>();
    if (number >= count) good_ = false;
    return static_cast<Enum>(good_ ? number : 0);
  }

 private:
  std::string_view take(std::size_t size) {
    if (!good_ || size > bytes_.size()) {
      good_ = false;
      return {};
    }
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  template <typename T>
  T integer() {
    std::make_unsigned_t<T> bits = 0;
    const std::string_view taken = take(sizeof(T));
    for (std::size_t k = taken.size(); k-- > 0;) {
      if constexpr (sizeof(T) > 1) bits = static_cast<decltype(bits)>(bits << 8);
      bits = static_cast<decltype(bits)>(bits | static_cast<std::uint8_t>(taken[k]));
    }
    return static_cast<T>(bits);
  }

  std::string_view bytes_;
  bool good_ = true;
};

}  // namespace plumbline::record
