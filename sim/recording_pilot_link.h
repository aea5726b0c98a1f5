// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/pilot_judge.h"
#include "drivers/pilot_link.h"
#include "drivers/text_queue.h"
#include "sim/virtual_clock.h"

namespace plumbline::sim {

// A pilot link without an autopilot, on a virtual clock: keeps what was said, and hears what it is
// told to hear. Its sink is called by whoever waits on the clock or works the far end. All members
// are called from that one thread.
class RecordingPilotLink : public PilotLink {
 public:
  struct Shown {
    HostTime time;
    PilotSeverity severity = PilotSeverity::kInfo;
    std::string text;  // as the pilot sees it
  };

  // Pulled out at first. `clock` outlives it.
  explicit RecordingPilotLink(VirtualClock& clock, std::string name = "the simulated autopilot");
  ~RecordingPilotLink() override;

  Status start(Sink sink) override;
  void stop() override;
  void say(PilotSeverity severity, std::string_view text) override;
  std::string name() const override { return name_; }
  PilotLinkCounters counters() const override;

  // What reached the far end.
  const std::vector<Shown>& shown() const { return shown_; }
  const std::vector<HostTime>& heartbeats() const { return heartbeats_; }

  // The far end, now; what it says is lost while it is pulled out or the link is not started.
  void plug_in();
  void pull();
  void hear(PilotMessage message);  // arrives now
  void hear_another();              // MAVLink, but not of an autopilot
  void hear_noise();                // bytes that are no message

 private:
  // What scheduled ticks reach, until stop().
  struct Run {
    Sink sink;
    PilotJudge judge;
    bool begun = false;
    bool was_in = false;
  };

  void begin();
  void open();
  void tick();
  void show_waiting();
  bool hears();
  std::string absence() const;

  VirtualClock& clock_;
  std::string name_;
  bool in_ = false;
  std::shared_ptr<Run> run_;
  HostTime next_heartbeat_;
  TextQueue texts_;
  std::vector<Shown> shown_;
  std::vector<HostTime> heartbeats_;
  PilotLinkCounters counters_;
};

}  // namespace plumbline::sim
