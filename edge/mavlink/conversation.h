// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "edge/base/pilot_protocol.h"
#include "edge/mavlink/frame_reader.h"

namespace plumbline::mavlink {

struct ConversationOptions {
  int system_id = 1;       // whose companion this is, 1 to 255, until the vehicle has been heard
  int component_id = 191;  // MAV_COMP_ID_ONBOARD_COMPUTER
};

// What a companion computer hears and says. It listens to one autopilot: the first whose heartbeat
// it hears, until that one has been silent for five seconds; the messages of others on the line
// (ground stations, gimbals, other vehicles) are counted and left. It bears the vehicle's number,
// and speaks MAVLink 2, unless the vehicle was only heard in MAVLink 1.
class Conversation : public PilotProtocol {
 public:
  explicit Conversation(Sink sink, ConversationOptions options = {});
  Conversation(const Conversation&) = delete;  // its reader calls back into it
  Conversation& operator=(const Conversation&) = delete;

  void feed(HostTime arrival, std::string_view bytes) override;
  void flush() override { reader_.flush(); }
  void cut() override { reader_.cut(); }

  std::string heartbeat() override;
  std::string text(PilotSeverity severity, std::string_view text) override;

  PilotCounters counters() const override { return reader_.counters(); }

 private:
  struct Vehicle {
    std::uint8_t system_id = 0;
    std::uint8_t component_id = 0;
    HostTime heard;
  };

  void take(const Frame& frame);
  void take_heartbeat(const Frame& frame);
  void take_attitude(const Frame& frame);
  bool is_vehicle(const Frame& frame) const;
  void hear(const Frame& frame);
  std::string frame_with(std::uint32_t id, std::string payload);

  Sink sink_;
  ConversationOptions options_;
  FrameReader reader_;
  HostTime arrival_;  // of the bytes that are being read
  std::optional<Vehicle> vehicle_;
  bool heard_v1_ = false;
  bool heard_v2_ = false;
  std::uint8_t sequence_ = 0;  // of the next frame sent
};

std::unique_ptr<PilotProtocol> make_conversation(PilotProtocol::Sink sink);

}  // namespace plumbline::mavlink
