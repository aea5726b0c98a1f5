// SPDX-License-Identifier: MIT
#include "edge/record/entry.h"

#include <optional>

#include "edge/record/pack_capture.h"
#include "edge/record/packing.h"

namespace plumbline::record {
namespace {

// Of the entries that are not of capture, which begin at kFirstInput and kFirstDecision.
enum Kind : std::uint16_t {
  kBegan = 1,
  kBytes = 2,
  kStored = 3,
  kMessage = 4,
  kEnded = 5,
  kPilotAttitude = 6,
  kPilotPosition = 7
};

void put(Packer& to, const Began& began) {
  to.put(began.host);
  to.put(began.wall);
  to.put(std::string_view(began.program));
  to.put(std::string_view(began.boot));
  to.put(std::string_view(began.configuration));
}

void put(Packer& to, const Bytes& bytes) {
  to.put(bytes.arrival);
  to.put(std::string_view(bytes.bytes));
}

void put(Packer& to, const Stored& stored) {
  to.put(stored.time);
  to.put(static_cast<std::int32_t>(stored.number));
  to.put(std::string_view(stored.name));
  to.put(stored.length);
  for (const std::uint8_t byte : stored.sha256) to.put(byte);
}

void put(Packer& to, const Message& message) {
  to.put(message.time);
  to.put(static_cast<std::uint8_t>(message.severity));
  to.put(std::string_view(message.source));
  to.put(std::string_view(message.sentence));
}

void put(Packer& to, const PilotAttitude& attitude) {
  to.put(attitude.arrival);
  to.put(std::chrono::nanoseconds(attitude.time_boot));
  to.put(attitude.roll_rad);
  to.put(attitude.pitch_rad);
  to.put(attitude.yaw_rad);
}

void put_optional(Packer& to, const std::optional<double>& value) {
  to.put(value.has_value());
  if (value) to.put(*value);
}

std::optional<double> get_optional(Unpacker& from) {
  if (!from.get<bool>()) return std::nullopt;
  return from.get<double>();
}

void put(Packer& to, const PilotPosition& position) {
  to.put(position.arrival);
  to.put(std::chrono::nanoseconds(position.time_boot));
  put_optional(to, position.latitude_deg);
  put_optional(to, position.longitude_deg);
  to.put(position.altitude_msl_m);
  to.put(position.relative_altitude_m);
  for (const double velocity : position.velocity_enu_m_s) to.put(velocity);
  put_optional(to, position.heading_deg);
}

void put(Packer& to, const Ended& ended) {
  to.put(ended.time);
  to.put(std::string_view(ended.why));
}

void put(Packer& to, const capture::Input& input) { pack_input(to, input); }
void put(Packer& to, const capture::Decision& decision) { pack_decision(to, decision); }

Began get_began(Unpacker& from) {
  Began began;
  began.host = from.get_time<HostTime>();
  began.wall = from.get_time<WallTime>();
  began.program = from.get<std::string>();
  began.boot = from.get<std::string>();
  began.configuration = from.get<std::string>();
  return began;
}

Stored get_stored(Unpacker& from) {
  Stored stored;
  stored.time = from.get_time<HostTime>();
  stored.number = from.get<std::int32_t>();
  stored.name = from.get<std::string>();
  stored.length = from.get<std::uint64_t>();
  for (std::uint8_t& byte : stored.sha256) byte = from.get<std::uint8_t>();
  return stored;
}

Message get_message(Unpacker& from) {
  Message message;
  message.time = from.get_time<HostTime>();
  message.severity = from.get_case<Severity>(3);
  message.source = from.get<std::string>();
  message.sentence = from.get<std::string>();
  return message;
}

std::chrono::milliseconds get_boot_time(Unpacker& from) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
      from.get<std::chrono::nanoseconds>());
}

PilotPosition get_position(Unpacker& from) {
  PilotPosition position;
  position.arrival = from.get_time<HostTime>();
  position.time_boot = get_boot_time(from);
  position.latitude_deg = get_optional(from);
  position.longitude_deg = get_optional(from);
  position.altitude_msl_m = from.get<double>();
  position.relative_altitude_m = from.get<double>();
  for (double& velocity : position.velocity_enu_m_s) velocity = from.get<double>();
  position.heading_deg = get_optional(from);
  return position;
}

PilotAttitude get_attitude(Unpacker& from) {
  PilotAttitude attitude;
  attitude.arrival = from.get_time<HostTime>();
  attitude.time_boot = get_boot_time(from);
  attitude.roll_rad = from.get<double>();
  attitude.pitch_rad = from.get<double>();
  attitude.yaw_rad = from.get<double>();
  return attitude;
}

std::optional<Entry> get_entry(std::uint16_t kind, Unpacker& from) {
  if (is_input(kind)) return unpack_input(kind, from);
  if (is_decision(kind)) return unpack_decision(kind, from);
  switch (kind) {
    case kBegan:
      return get_began(from);
    case kBytes: {
      const auto arrival = from.get_time<HostTime>();
      return Bytes{arrival, from.get<std::string>()};
    }
    case kStored:
      return get_stored(from);
    case kMessage:
      return get_message(from);
    case kEnded: {
      const auto time = from.get_time<HostTime>();
      return Ended{time, from.get<std::string>()};
    }
    case kPilotAttitude:
      return get_attitude(from);
    case kPilotPosition:
      return get_position(from);
    default:
      return std::nullopt;
  }
}

struct KindOf {
  std::uint16_t operator()(const Began&) const { return kBegan; }
  std::uint16_t operator()(const Bytes&) const { return kBytes; }
  std::uint16_t operator()(const Stored&) const { return kStored; }
  std::uint16_t operator()(const Message&) const { return kMessage; }
  std::uint16_t operator()(const Ended&) const { return kEnded; }
  std::uint16_t operator()(const PilotAttitude&) const { return kPilotAttitude; }
  std::uint16_t operator()(const PilotPosition&) const { return kPilotPosition; }
  std::uint16_t operator()(const capture::Input& input) const { return kind_of_input(input); }
  std::uint16_t operator()(const capture::Decision& decision) const {
    return kind_of_decision(decision);
  }
};

}  // namespace

std::uint16_t kind_of(const Entry& entry) { return std::visit(KindOf{}, entry); }

void pack(const Entry& entry, std::string& out) {
  Packer to(out);
  std::visit([&](const auto& what) { put(to, what); }, entry);
}

Result<Entry> unpack(std::uint16_t kind, std::string_view bytes) {
  Unpacker from(bytes);
  auto entry = get_entry(kind, from);
  if (!entry) {
    return Error{"An entry of kind " + std::to_string(kind) +
                 " is not known here: it was written by a later version; read it with that."};
  }
  if (!from.good() || !from.at_end()) {
    return Error{"An entry of kind " + std::to_string(kind) +
                 " is not as record_format.md says: the program that wrote it is in error."};
  }
  return std::move(*entry);
}

}  // namespace plumbline::record
