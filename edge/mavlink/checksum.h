// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace plumbline::mavlink {

// CRC-16/MCRF4XX, which MAVLink calls X.25: polynomial 0x1021 reflected, begun with 0xFFFF, not
// inverted at the end. Of "123456789" it is 0x6F91.
class Checksum {
 public:
  void add(std::uint8_t byte) {
    auto mixed = static_cast<std::uint8_t>(byte ^ (value_ & 0xFF));
    mixed = static_cast<std::uint8_t>(mixed ^ (mixed << 4));
    value_ = static_cast<std::uint16_t>((value_ >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
  }

  void add(std::string_view bytes) {
    for (const char byte : bytes) add(static_cast<std::uint8_t>(byte));
  }

  std::uint16_t value() const { return value_; }

 private:
  std::uint16_t value_ = 0xFFFF;
};

}  // namespace plumbline::mavlink
