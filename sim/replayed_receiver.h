// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "sim/line_piece.h"
#include "sim/sim_receiver.h"

namespace plumbline::sim {

// A receiver whose line is played from a source, piece by piece at their times: a recording, or a
// GnssStream. Playing begins with the first start() and goes on while it is stopped, as a receiver
// does that nobody reads.
class ReplayedReceiver : public GnssReceiver {
 public:
  // `clock` outlives it.
  ReplayedReceiver(VirtualClock& clock, MakeFixDecoder make_decoder, LineSource source,
                   std::string name = "the replayed receiver");
  ReplayedReceiver(const ReplayedReceiver&) = delete;  // the clock calls back into it
  ReplayedReceiver& operator=(const ReplayedReceiver&) = delete;

  Status start(Sink sink) override;
  void stop() override { line_.stop(); }
  std::string name() const override { return line_.name(); }
  ReceiverCounters counters() const override { return line_.counters(); }

  // Asks a source that had nothing more whether it has.
  void resume();

 private:
  void play(const LinePiece& piece);

  VirtualClock& clock_;
  LineSource source_;
  SimReceiver line_;
  bool playing_ = false;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace plumbline::sim
