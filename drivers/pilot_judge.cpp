// SPDX-License-Identifier: MIT
#include "drivers/pilot_judge.h"

#include <chrono>

namespace plumbline {
namespace {

// An autopilot sends a heartbeat each second; three of them may be lost.
constexpr std::chrono::milliseconds kPilotPatience{3500};

}  // namespace

void PilotJudge::opened(HostTime now) {
  open_ = true;
  last_byte_ = last_frame_ = last_heartbeat_ = now;
}

void PilotJudge::absent(HostTime now, const std::string& sentence) {
  open_ = false;
  if (state_ == PilotState::kAbsent && sentence != sentence_) reported_ = false;
  become(now, PilotState::kAbsent, sentence);
}

// After a silence the others get their time from here.
void PilotJudge::bytes_came(HostTime now) {
  if (now - last_byte_ >= kPilotPatience) last_frame_ = last_heartbeat_ = now;
  last_byte_ = now;
}

void PilotJudge::heartbeat_came(HostTime now) {
  last_heartbeat_ = now;
  become(now, PilotState::kAutopilot, "An autopilot is heard on " + name_ + ".");
}

void PilotJudge::look(HostTime now) {
  if (!open_) return;
  if (now - last_byte_ >= kPilotPatience) {
    become(now, PilotState::kSilent,
           "Nothing comes from the autopilot on " + name_ +
               ": check its power and cable, and that its telemetry goes to this port.");
  } else if (now - last_frame_ >= kPilotPatience) {
    become(now, PilotState::kGarbled,
           "What comes on " + name_ +
               " is not MAVLink: set the autopilot's telemetry port to MAVLink and to this speed, "
               "and check the cable.");
  } else if (now - last_heartbeat_ >= kPilotPatience) {
    become(now, PilotState::kNoAutopilot,
           "MAVLink comes on " + name_ +
               ", but no heartbeat of an autopilot: check what is connected there.");
  }
}

void PilotJudge::become(HostTime now, PilotState state, const std::string& sentence) {
  if (reported_ && state == state_) return;
  reported_ = true;
  state_ = state;
  sentence_ = sentence;
  sink_({now, state, sentence});
}

}  // namespace plumbline
