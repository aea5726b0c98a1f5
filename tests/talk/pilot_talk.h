// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::talk {

// MAVLink as it is published, apart from edge/mavlink: message definitions as the XML files have
// them, and frames made from these by the rules of the protocol's guide (fields sorted by size,
// CRC_EXTRA over names and types).

struct PublishedField {
  std::string type;  // "uint8_t", "float", "char[50]" without its brackets
  std::string name;
  int array_length = 0;  // 0: no array
  bool is_extension = false;
};

// Fields in the order of the XML file.
struct PublishedMessage {
  std::uint32_t id;
  std::string name;
  std::vector<PublishedField> fields;
};

const PublishedMessage& published(std::string_view name);
std::uint8_t crc_extra_of(const PublishedMessage& message);
std::size_t length_of(const PublishedMessage& message, bool with_extensions);

struct PilotSender {
  int version = 2;
  int sequence = 0;
  int system = 1;
  int component = 1;
  int incompatibility_flags = 0;
};

// Fields not named are 0; `text` is what arrays of characters hold.
struct PilotSays {
  std::string name;
  std::map<std::string, double> values;
  std::string text;
};

std::string pilot_frame(const PilotSays& says, const PilotSender& sender = {});

// A frame of any id, also of one that is not in the list.
std::string pilot_frame(std::uint32_t id, std::uint8_t crc_extra, const std::string& payload,
                        const PilotSender& sender = {});

// A quadrotor's messages at an instant of its clock.
std::string vehicle_heartbeat(bool armed, const PilotSender& sender = {});
std::string vehicle_attitude(int time_boot_ms, double yaw_rad, const PilotSender& sender = {});
std::string vehicle_position(int time_boot_ms, double relative_altitude_m,
                             const PilotSender& sender = {});

std::string from_hex(std::string_view hex);

}  // namespace plumbline::talk
