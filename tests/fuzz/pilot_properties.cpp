// SPDX-License-Identifier: MIT
#include "tests/fuzz/pilot_properties.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "edge/mavlink/conversation.h"
#include "edge/mavlink/messages.h"

namespace plumbline::fuzz {
namespace {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

bool is_within(const std::optional<double>& value, double limit) {
  return !value || std::abs(*value) <= limit;
}

// What a message says as text, after a look at its numbers.
struct Checked {
  std::ostream& out;

  void operator()(const PilotHeartbeat& heartbeat) const {
    require(heartbeat.autopilot != 8, "a heartbeat is that of an autopilot");
    out << "H" << heartbeat.armed << heartbeat.system_id << heartbeat.vehicle_type << "\n";
  }

  void operator()(const PilotAttitude& attitude) const {
    require(std::isfinite(attitude.roll_rad + attitude.pitch_rad), "an angle is a number");
    require(std::isfinite(attitude.yaw_rad), "an angle is a number");
    require(attitude.time_boot.count() >= 0, "no time before the start");
    out << "A" << attitude.roll_rad << "," << attitude.yaw_rad << "\n";
  }

  void operator()(const PilotPosition& position) const {
    require(is_within(position.latitude_deg, 90), "latitudes end at the poles");
    require(is_within(position.longitude_deg, 180), "longitudes end at the half turn");
    require(position.latitude_deg.has_value() == position.longitude_deg.has_value(),
            "a position is both");
    require(is_within(position.heading_deg, 360), "headings end after one turn");
    out << "P" << position.altitude_msl_m << "," << position.velocity_enu_m_s.sum() << "\n";
  }
};

struct Heard {
  std::string messages;
  PilotCounters counters;
};

Heard hear(std::string_view bytes, std::size_t piece) {
  std::ostringstream messages;
  mavlink::Conversation conversation(
      [&](const PilotMessage& message) { std::visit(Checked{messages}, message); });
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) {
    conversation.feed(HostTime{}, bytes.substr(0, piece));
  }
  conversation.flush();
  return {messages.str(), conversation.counters()};
}

void require_counts(const PilotCounters& counters, std::size_t size) {
  require(counters.bytes == size, "every byte is counted");
  constexpr std::size_t kShortestFrame = 8;
  require(counters.garbage_bytes + kShortestFrame * (counters.frames + counters.unknown) <= size,
          "a byte is of a frame or garbage");
  require(counters.frames + counters.unknown > 0 || counters.garbage_bytes == size,
          "what is of no frame is garbage");
  require(counters.malformed + counters.incompatible + counters.of_others <= counters.frames,
          "what is dropped was a frame");
}

void require_a_text_to_be_read(std::string_view text) {
  mavlink::Conversation conversation([](const PilotMessage&) {});
  const std::string bytes = conversation.text(PilotSeverity::kNotice, text);
  int texts = 0;
  mavlink::FrameReader reader([&](const mavlink::Frame& frame) {
    const auto status = mavlink::status_text_of(frame);
    require(status && status->severity == PilotSeverity::kNotice, "a severity is kept");
    require(status->text == mavlink::fitted(text), "a text is kept");
    require(status->text.size() <= mavlink::kLongestText, "a text fits");
    ++texts;
  });
  reader.feed(bytes);
  require(texts == 1, "a text is one frame");
}

}  // namespace

void check_conversation(std::string_view bytes) {
  if (bytes.empty()) return;
  const Heard whole = hear(bytes, bytes.size());
  require_counts(whole.counters, bytes.size());
  const std::size_t chance = static_cast<unsigned char>(bytes.back());
  for (const std::size_t piece : {std::size_t{1}, 1 + chance % 97}) {
    const Heard pieces = hear(bytes, piece);
    require(pieces.messages == whole.messages, "pieces give the same messages");
    require(pieces.counters.garbage_bytes == whole.counters.garbage_bytes,
            "pieces hold the same garbage");
    require(pieces.counters.unknown == whole.counters.unknown, "pieces hold the same frames");
  }
  require_a_text_to_be_read(bytes);
}

}  // namespace plumbline::fuzz
