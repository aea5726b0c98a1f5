// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <thread>

#include "drivers/clock.h"
#include "drivers/signal.h"
#include "edge/base/result.h"
#include "sim/line_piece.h"
#include "sim/pty_port.h"

namespace plumbline::sim {

// Plays a receiver's line through a pseudo-terminal, in real time, on a thread of its own.
class LivePort {
 public:
  // `path` must not exist; `clock` outlives it.
  LivePort(Clock& clock, const std::string& path, LineSource source);
  ~LivePort();

  // Fails as PtyPort::plug_in(). The port is plugged in from then on.
  Status start();

 private:
  void play(const std::stop_token& stop);
  void bring(const LinePiece& piece);

  Clock& clock_;
  Signal signal_;
  LineSource source_;
  PtyPort port_;
  bool plugged_in_ = false;
  std::jthread thread_;
};

}  // namespace plumbline::sim
