// SPDX-License-Identifier: MIT
#include "edge/mavlink/messages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <type_traits>

namespace plumbline::mavlink {
namespace {

constexpr int kOnboardController = 18;  // MAV_TYPE
constexpr int kOwnAutopilot = 8;        // MAV_AUTOPILOT_INVALID
constexpr int kActive = 4;              // MAV_STATE
constexpr int kProtocolVersion = 3;     // of both MAVLink 1 and 2
constexpr int kSafetyArmed = 128;       // MAV_MODE_FLAG
constexpr int kWholeTurn = 36000;       // 0.01 degree; 65535 says that it is unknown

// A little-endian whole number at an offset of the payload.
template <typename T>
T whole(const Frame& frame, std::size_t offset) {
  std::make_unsigned_t<T> value = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) {
    value =
        static_cast<std::make_unsigned_t<T>>((static_cast<std::uint64_t>(value) << 8) |
                                             static_cast<std::uint8_t>(frame.payload[offset + i]));
  }
  return static_cast<T>(value);
}

double real(const Frame& frame, std::size_t offset) {
  return static_cast<double>(std::bit_cast<float>(whole<std::uint32_t>(frame, offset)));
}

std::chrono::milliseconds time_boot_of(const Frame& frame) {
  return std::chrono::milliseconds(whole<std::uint32_t>(frame, 0));
}

bool continues_a_character(char c) { return (static_cast<std::uint8_t>(c) & 0xC0) == 0x80; }

std::string in_ascii(std::string_view text) {
  std::string ascii;
  for (const char c : text) {
    if (continues_a_character(c)) continue;
    const bool space = c == '\n' || c == '\r' || c == '\t';
    const bool printable = c >= ' ' && c <= '~';
    ascii += space ? ' ' : printable ? c : '?';
  }
  return ascii;
}

void set_position(PilotPosition& position, std::int32_t latitude_e7, std::int32_t longitude_e7) {
  const bool none = latitude_e7 == 0 && longitude_e7 == 0;  // what is sent before the first fix
  const double latitude_deg = latitude_e7 * 1e-7;
  const double longitude_deg = longitude_e7 * 1e-7;
  if (none || std::abs(latitude_deg) > 90 || std::abs(longitude_deg) > 180) return;
  position.latitude_deg = latitude_deg;
  position.longitude_deg = longitude_deg;
}

}  // namespace

std::string own_heartbeat_payload() {
  std::string payload(4, '\0');  // custom_mode
  payload += static_cast<char>(kOnboardController);
  payload += static_cast<char>(kOwnAutopilot);
  payload += '\0';  // base_mode
  payload += static_cast<char>(kActive);
  payload += static_cast<char>(kProtocolVersion);
  return payload;
}

std::string status_text_payload(const StatusText& status) {
  std::string payload(1, static_cast<char>(status.severity));
  return payload + status.text;  // zeros to its end, and in the extensions: one piece, no number
}

std::string fitted(std::string_view text) {
  std::string ascii = in_ascii(text);
  if (ascii.size() > kLongestText) {
    const std::size_t space = ascii.rfind(' ', kLongestText);
    ascii.resize(space == std::string::npos || space == 0 ? kLongestText : space);
  }
  ascii.erase(ascii.find_last_not_of(' ') + 1);
  return ascii;
}

// custom_mode 0, type 4, autopilot 5, base_mode 6, system_status 7, mavlink_version 8.
PilotHeartbeat heartbeat_of(const Frame& frame, HostTime arrival) {
  PilotHeartbeat heartbeat;
  heartbeat.arrival = arrival;
  heartbeat.armed = (whole<std::uint8_t>(frame, 6) & kSafetyArmed) != 0;
  heartbeat.system_id = frame.system_id;
  heartbeat.autopilot = whole<std::uint8_t>(frame, 5);
  heartbeat.vehicle_type = whole<std::uint8_t>(frame, 4);
  heartbeat.system_status = whole<std::uint8_t>(frame, 7);
  return heartbeat;
}

// time_boot_ms 0, roll 4, pitch 8, yaw 12, and their speeds.
std::optional<PilotAttitude> attitude_of(const Frame& frame, HostTime arrival) {
  const PilotAttitude attitude{arrival, time_boot_of(frame), real(frame, 4), real(frame, 8),
                               real(frame, 12)};
  const bool numbers = std::isfinite(attitude.roll_rad) && std::isfinite(attitude.pitch_rad) &&
                       std::isfinite(attitude.yaw_rad);
  return numbers ? std::optional(attitude) : std::nullopt;
}

// time_boot_ms 0, lat 4, lon 8 (1e-7 degree), alt 12, relative_alt 16 (mm), vx 20, vy 22, vz 24
// (north, east, down, cm/s), hdg 26 (0.01 degree).
PilotPosition position_of(const Frame& frame, HostTime arrival) {
  PilotPosition position;
  position.arrival = arrival;
  position.time_boot = time_boot_of(frame);
  set_position(position, whole<std::int32_t>(frame, 4), whole<std::int32_t>(frame, 8));
  position.altitude_msl_m = whole<std::int32_t>(frame, 12) * 1e-3;
  position.relative_altitude_m = whole<std::int32_t>(frame, 16) * 1e-3;
  position.velocity_enu_m_s = {whole<std::int16_t>(frame, 22) * 1e-2,
                               whole<std::int16_t>(frame, 20) * 1e-2,
                               whole<std::int16_t>(frame, 24) * -1e-2};
  const int heading = whole<std::uint16_t>(frame, 26);
  if (heading <= kWholeTurn) position.heading_deg = heading * 1e-2;
  return position;
}

// severity 0, text 1 to 50, and the extensions id and chunk_seq.
std::optional<StatusText> status_text_of(const Frame& frame) {
  const int severity = whole<std::uint8_t>(frame, 0);
  if (severity > static_cast<int>(PilotSeverity::kDebug)) return std::nullopt;
  std::string text = frame.payload.substr(1, kLongestText);
  text.resize(std::min(text.find('\0'), text.size()));
  return StatusText{static_cast<PilotSeverity>(severity), text};
}

}  // namespace plumbline::mavlink
