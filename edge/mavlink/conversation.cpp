// SPDX-License-Identifier: MIT
#include "edge/mavlink/conversation.h"

#include <chrono>
#include <utility>

#include "edge/mavlink/messages.h"

namespace plumbline::mavlink {
namespace {

constexpr std::chrono::seconds kVehicleLost{5};
constexpr int kNoAutopilot = 8;    // MAV_AUTOPILOT_INVALID
constexpr int kGroundStation = 6;  // MAV_TYPE_GCS

// Gimbals, cameras and companions say that they are no autopilot; a few ground stations do not.
bool is_of_an_autopilot(const PilotHeartbeat& heartbeat) {
  return heartbeat.autopilot != kNoAutopilot && heartbeat.vehicle_type != kGroundStation;
}

}  // namespace

Conversation::Conversation(Sink sink, ConversationOptions options)
    : sink_(std::move(sink)),
      options_(options),
      reader_([this](const Frame& frame) { take(frame); }) {}

void Conversation::feed(HostTime arrival, std::string_view bytes) {
  arrival_ = arrival;
  reader_.feed(bytes);
}

void Conversation::take(const Frame& frame) {
  if (frame.id == kHeartbeat) {
    take_heartbeat(frame);
  } else if (!is_vehicle(frame)) {
    ++reader_.counters().of_others;
  } else if (frame.id == kAttitude) {
    take_attitude(frame);
  } else if (frame.id == kGlobalPositionInt) {
    hear(frame);
    sink_(position_of(frame, arrival_));
  }
}

void Conversation::take_heartbeat(const Frame& frame) {
  const PilotHeartbeat heartbeat = heartbeat_of(frame, arrival_);
  const bool free = !vehicle_ || arrival_ - vehicle_->heard >= kVehicleLost;
  if (!is_of_an_autopilot(heartbeat) || !(free || is_vehicle(frame))) {
    ++reader_.counters().of_others;
    return;
  }
  if (!is_vehicle(frame)) {
    vehicle_ = Vehicle{frame.system_id, frame.component_id, arrival_};
    heard_v1_ = heard_v2_ = false;
  }
  vehicle_->heard = arrival_;
  hear(frame);
  sink_(heartbeat);
}

void Conversation::take_attitude(const Frame& frame) {
  hear(frame);
  if (const auto attitude = attitude_of(frame, arrival_)) {
    sink_(*attitude);
  } else {
    ++reader_.counters().malformed;
  }
}

bool Conversation::is_vehicle(const Frame& frame) const {
  return vehicle_ && vehicle_->system_id == frame.system_id &&
         vehicle_->component_id == frame.component_id;
}

void Conversation::hear(const Frame& frame) {
  heard_v1_ = heard_v1_ || frame.version == 1;
  heard_v2_ = heard_v2_ || frame.version == 2;
}

std::string Conversation::heartbeat() { return frame_with(kHeartbeat, own_heartbeat_payload()); }

std::string Conversation::text(PilotSeverity severity, std::string_view text) {
  return frame_with(kStatusText, status_text_payload({severity, fitted(text)}));
}

std::string Conversation::frame_with(std::uint32_t id, std::string payload) {
  Frame frame;
  frame.version = heard_v2_ || !heard_v1_ ? 2 : 1;
  frame.sequence = sequence_++;
  frame.system_id = vehicle_ ? vehicle_->system_id : static_cast<std::uint8_t>(options_.system_id);
  frame.component_id = static_cast<std::uint8_t>(options_.component_id);
  frame.id = id;
  frame.payload = std::move(payload);
  return bytes_of(frame);
}

std::unique_ptr<PilotProtocol> make_conversation(PilotProtocol::Sink sink) {
  return std::make_unique<Conversation>(std::move(sink));
}

}  // namespace plumbline::mavlink
