// SPDX-License-Identifier: MIT
#include "edge/mavlink/frame.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "edge/mavlink/checksum.h"

namespace plumbline::mavlink {
namespace {

constexpr std::array kDefinitions = {
    Definition{kHeartbeat, 50, 9, 9}, Definition{kAttitude, 39, 28, 28},
    Definition{kGlobalPositionInt, 104, 28, 28}, Definition{kStatusText, 83, 51, 54}};

std::string without_zeros_at_end(std::string payload) {
  const std::size_t last = payload.find_last_not_of('\0');
  payload.resize(last == std::string::npos ? 1 : last + 1);
  return payload;
}

std::string header_of(const Frame& frame, std::size_t payload_size) {
  const auto byte = [](std::size_t value) { return static_cast<char>(value & 0xFF); };
  std::string header = frame.version == 1 ? "\xFE" : "\xFD";
  header += byte(payload_size);
  if (frame.version == 2) header += std::string(2, '\0');  // no flags of either kind
  header += byte(frame.sequence);
  header += byte(frame.system_id);
  header += byte(frame.component_id);
  header += byte(frame.id);
  if (frame.version == 2) {
    header += byte(frame.id >> 8);
    header += byte(frame.id >> 16);
  }
  return header;
}

}  // namespace

const Definition* find_definition(std::uint32_t id) {
  const auto found = std::find_if(kDefinitions.begin(), kDefinitions.end(),
                                  [id](const Definition& known) { return known.id == id; });
  return found == kDefinitions.end() ? nullptr : &*found;
}

std::string bytes_of(const Frame& frame) {
  const Definition& definition = *find_definition(frame.id);
  std::string payload = frame.payload;
  payload.resize(frame.version == 1 ? definition.length_v1 : definition.length_full);
  if (frame.version == 2) payload = without_zeros_at_end(std::move(payload));
  std::string bytes = header_of(frame, payload.size()) + payload;
  Checksum checksum;
  checksum.add(std::string_view(bytes).substr(1));  // all but the start mark
  checksum.add(definition.crc_extra);
  bytes += static_cast<char>(checksum.value() & 0xFF);
  bytes += static_cast<char>(checksum.value() >> 8);
  return bytes;
}

}  // namespace plumbline::mavlink
