// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "edge/base/pilot_messages.h"
#include "edge/mavlink/frame.h"

namespace plumbline::mavlink {

inline constexpr std::size_t kLongestText = 50;  // characters of a STATUSTEXT

// A message of this side: what it is made of, and its payload.
struct StatusText {
  PilotSeverity severity = PilotSeverity::kInfo;
  std::string text;
};

// The payload of a HEARTBEAT of an onboard controller without an autopilot, active.
std::string own_heartbeat_payload();

// `text` as fitted() leaves it.
std::string status_text_payload(const StatusText& status);

// The text in 50 ASCII characters at most: longer ones are cut after a word, or within a word that
// fills them alone; any other character becomes '?', a line end a space.
std::string fitted(std::string_view text);

// What a frame says, by its id; `arrival` is handed through. Nothing where a number is none (an
// angle that is not finite) or a severity is out of range. The payload has its full length.
PilotHeartbeat heartbeat_of(const Frame& frame, HostTime arrival);
std::optional<PilotAttitude> attitude_of(const Frame& frame, HostTime arrival);
PilotPosition position_of(const Frame& frame, HostTime arrival);
std::optional<StatusText> status_text_of(const Frame& frame);

}  // namespace plumbline::mavlink
