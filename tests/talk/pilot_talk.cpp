// SPDX-License-Identifier: MIT
#include "tests/talk/pilot_talk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace plumbline::talk {
namespace {

const std::vector<PublishedMessage> kPublished = {
    {0,
     "HEARTBEAT",
     {{"uint8_t", "type"},
      {"uint8_t", "autopilot"},
      {"uint8_t", "base_mode"},
      {"uint32_t", "custom_mode"},
      {"uint8_t", "system_status"},
      {"uint8_t", "mavlink_version"}}},
    {2, "SYSTEM_TIME", {{"uint64_t", "time_unix_usec"}, {"uint32_t", "time_boot_ms"}}},
    {30,
     "ATTITUDE",
     {{"uint32_t", "time_boot_ms"},
      {"float", "roll"},
      {"float", "pitch"},
      {"float", "yaw"},
      {"float", "rollspeed"},
      {"float", "pitchspeed"},
      {"float", "yawspeed"}}},
    {33,
     "GLOBAL_POSITION_INT",
     {{"uint32_t", "time_boot_ms"},
      {"int32_t", "lat"},
      {"int32_t", "lon"},
      {"int32_t", "alt"},
      {"int32_t", "relative_alt"},
      {"int16_t", "vx"},
      {"int16_t", "vy"},
      {"int16_t", "vz"},
      {"uint16_t", "hdg"}}},
    {253,
     "STATUSTEXT",
     {{"uint8_t", "severity"},
      {"char", "text", 50},
      {"uint16_t", "id", 0, true},
      {"uint8_t", "chunk_seq", 0, true}}}};

std::size_t size_of(const std::string& type) {
  if (type == "char" || type == "uint8_t") return 1;
  if (type == "int16_t" || type == "uint16_t") return 2;
  if (type == "uint64_t") return 8;
  return 4;
}

// As they are sent: the larger types first, extensions last and unsorted.
std::vector<PublishedField> in_wire_order(const PublishedMessage& message) {
  std::vector<PublishedField> fields = message.fields;
  const auto extensions = std::stable_partition(
      fields.begin(), fields.end(), [](const auto& field) { return !field.is_extension; });
  std::stable_sort(fields.begin(), extensions,
                   [](const auto& a, const auto& b) { return size_of(a.type) > size_of(b.type); });
  return fields;
}

// Bit by bit, from the polynomial.
std::uint16_t x25(std::string_view bytes) {
  unsigned crc = 0xFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0x8408u : 0u);
  }
  return static_cast<std::uint16_t>(crc);
}

std::string little_endian(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFF);
  return bytes;
}

std::string field_bytes(const PublishedField& field, const PilotSays& says) {
  if (field.array_length > 0) {
    std::string text = says.text;
    text.resize(static_cast<std::size_t>(field.array_length));
    return text;
  }
  const auto found = says.values.find(field.name);
  const double value = found == says.values.end() ? 0 : found->second;
  if (field.type == "float") {
    return little_endian(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  }
  return little_endian(static_cast<std::uint64_t>(std::llround(value)), size_of(field.type));
}

std::string header_of(std::uint32_t id, std::size_t size, const PilotSender& sender) {
  std::string header(1, sender.version == 1 ? '\xFE' : '\xFD');
  header += static_cast<char>(size);
  if (sender.version == 2) {
    header += static_cast<char>(sender.incompatibility_flags);
    header += '\0';
  }
  for (const int part : {sender.sequence, sender.system, sender.component}) {
    header += static_cast<char>(part);
  }
  return header + little_endian(id, sender.version == 1 ? 1 : 3);
}

}  // namespace

const PublishedMessage& published(std::string_view name) {
  for (const PublishedMessage& message : kPublished) {
    if (message.name == name) return message;
  }
  throw std::invalid_argument(std::string(name) + " is not in the list");
}

std::uint8_t crc_extra_of(const PublishedMessage& message) {
  std::string text = message.name + " ";
  for (const PublishedField& field : in_wire_order(message)) {
    if (field.is_extension) continue;
    text += field.type + " " + field.name + " ";
    if (field.array_length > 0) text += static_cast<char>(field.array_length);
  }
  const std::uint16_t crc = x25(text);
  return static_cast<std::uint8_t>((crc & 0xFF) ^ (crc >> 8));
}

std::size_t length_of(const PublishedMessage& message, bool with_extensions) {
  std::size_t length = 0;
  for (const PublishedField& field : message.fields) {
    if (field.is_extension && !with_extensions) continue;
    length += size_of(field.type) * static_cast<std::size_t>(std::max(field.array_length, 1));
  }
  return length;
}

std::string pilot_frame(const PilotSays& says, const PilotSender& sender) {
  const PublishedMessage& message = published(says.name);
  std::string payload;
  for (const PublishedField& field : in_wire_order(message)) {
    if (field.is_extension && sender.version == 1) continue;
    payload += field_bytes(field, says);
  }
  while (sender.version == 2 && payload.size() > 1 && payload.back() == '\0') payload.pop_back();
  return pilot_frame(message.id, crc_extra_of(message), payload, sender);
}

std::string pilot_frame(std::uint32_t id, std::uint8_t crc_extra, const std::string& payload,
                        const PilotSender& sender) {
  const std::string frame = header_of(id, payload.size(), sender) + payload;
  return frame + little_endian(x25(frame.substr(1) + static_cast<char>(crc_extra)), 2);
}

std::string vehicle_heartbeat(bool armed, const PilotSender& sender) {
  return pilot_frame({"HEARTBEAT",
                      {{"type", 2},
                       {"autopilot", 3},
                       {"base_mode", armed ? 128 + 81 : 81},
                       {"custom_mode", 4},
                       {"system_status", armed ? 4 : 3},
                       {"mavlink_version", 3}},
                      ""},
                     sender);
}

std::string vehicle_attitude(int time_boot_ms, double yaw_rad, const PilotSender& sender) {
  return pilot_frame(
      {"ATTITUDE",
       {{"time_boot_ms", time_boot_ms}, {"roll", 0.0125}, {"pitch", -0.05}, {"yaw", yaw_rad}},
       ""},
      sender);
}

std::string vehicle_position(int time_boot_ms, double relative_altitude_m,
                             const PilotSender& sender) {
  return pilot_frame({"GLOBAL_POSITION_INT",
                      {{"time_boot_ms", time_boot_ms},
                       {"lat", 356687390},
                       {"lon", 1397610904},
                       {"alt", 52140},
                       {"relative_alt", relative_altitude_m * 1000},
                       {"vz", -300},
                       {"hdg", 9000}},
                      ""},
                     sender);
}

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

}  // namespace plumbline::talk
