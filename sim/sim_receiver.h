// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "drivers/gnss_receiver.h"
#include "drivers/receiver_watch.h"
#include "sim/virtual_clock.h"

namespace plumbline::sim {

// A receiver without hardware, on a virtual clock: what it makes of its line is what the real
// driver makes of it. Its sink is called by whoever waits on the clock or works the line's far end.
// All members are called from that one thread.
class SimReceiver : public GnssReceiver {
 public:
  // Pulled out at first. `clock` outlives it.
  SimReceiver(VirtualClock& clock, MakeFixDecoder make_decoder,
              std::string name = "the simulated receiver");
  ~SimReceiver() override;

  Status start(Sink sink) override;
  void stop() override;
  std::string name() const override { return name_; }
  ReceiverCounters counters() const override;

  // The far end of the line, now. Bytes are lost while it is pulled out or not started.
  void plug_in();
  void pull();
  void send(std::string_view bytes);

 private:
  // What scheduled looks reach, until stop().
  struct Run {
    ReceiverWatch watch;
    bool begun = false;
    HostTime look_at = HostTime::max();  // the earliest look that is scheduled
  };

  void begin();
  void schedule_look();
  std::string absence() const;

  VirtualClock& clock_;
  MakeFixDecoder make_decoder_;
  std::string name_;
  bool in_ = false;
  std::shared_ptr<Run> run_;
  ReceiverCounters counters_;  // of the run before
};

}  // namespace plumbline::sim
