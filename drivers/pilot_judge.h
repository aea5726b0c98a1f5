// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "drivers/pilot_link.h"

namespace plumbline {

// Says in which state a pilot link is, from what arrives and what does not. It reports when the
// state changes. Knows no clock: every call brings the time, which never goes back.
class PilotJudge {
 public:
  using Sink = std::function<void(PilotReport)>;

  // `name` for the sentences: "/dev/ttyAMA1 at 57600 baud".
  PilotJudge(std::string name, Sink sink) : name_(std::move(name)), sink_(std::move(sink)) {}

  void opened(HostTime now);
  void absent(HostTime now, const std::string& sentence);
  void bytes_came(HostTime now);
  void frame_came(HostTime now) { last_frame_ = now; }  // of any kind and sender
  void heartbeat_came(HostTime now);

  void look(HostTime now);  // at what has not come: twice a second at least

 private:
  void become(HostTime now, PilotState state, const std::string& sentence);

  std::string name_;
  Sink sink_;
  bool open_ = false;
  bool reported_ = false;
  PilotState state_ = PilotState::kAbsent;
  std::string sentence_;
  HostTime last_byte_;
  HostTime last_frame_;
  HostTime last_heartbeat_;
};

}  // namespace plumbline
