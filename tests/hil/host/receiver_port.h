// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "drivers/posix/descriptor.h"
#include "drivers/posix/system_clock.h"
#include "drivers/signal.h"
#include "sim/line_piece.h"

namespace plumbline::hil {

// Plays a receiver's line, in real time and on a thread of its own, into the socket behind QEMU's
// usb-serial device. What the guest does not take is lost, as on a line; what it sends is ignored.
class ReceiverPort {
 public:
  ReceiverPort(posix::Descriptor socket, sim::LineSource source);
  ~ReceiverPort();

 private:
  void play(const std::stop_token& stop);
  void ignore_guest();

  posix::Descriptor socket_;
  sim::LineSource source_;
  posix::SystemClock clock_;
  Signal signal_;
  std::jthread thread_;
};

}  // namespace plumbline::hil
