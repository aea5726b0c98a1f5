// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace plumbline::mavlink {

// The messages that are read or written here, by their numbers in the published definitions
// (minimal.xml and common.xml).
inline constexpr std::uint32_t kHeartbeat = 0;
inline constexpr std::uint32_t kAttitude = 30;
inline constexpr std::uint32_t kGlobalPositionInt = 33;
inline constexpr std::uint32_t kStatusText = 253;

// What sender and receiver must agree on.
struct Definition {
  std::uint32_t id;
  std::uint8_t crc_extra;   // one byte of the checksum over names and types of the fields
  std::size_t length_v1;    // of the payload, without extension fields
  std::size_t length_full;  // with them; an even newer sender may send more
};

// nullptr for a message that is not read here. MAVLink 1 has ids up to 255.
const Definition* find_definition(std::uint32_t id);

// One message on its way, without its checksum.
struct Frame {
  int version = 2;  // 1 or 2
  std::uint8_t sequence = 0;
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  std::uint32_t id = 0;
  std::string payload;  // fields in the order of their sizes, little-endian
};

// The bytes of a frame whose id has a definition: MAVLink 2 leaves out the zeros at the payload's
// end, but its first byte never; MAVLink 1 leaves out the extension fields.
std::string bytes_of(const Frame& frame);

}  // namespace plumbline::mavlink
