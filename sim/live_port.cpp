// SPDX-License-Identifier: MIT
#include "sim/live_port.h"

#include <utility>

namespace plumbline::sim {

LivePort::LivePort(Clock& clock, const std::string& path, LineSource source)
    : clock_(clock), source_(std::move(source)), port_(path) {}

LivePort::~LivePort() {
  thread_.request_stop();
  signal_.raise();
  if (thread_.joinable()) thread_.join();
}

Status LivePort::start() {
  Status plugged_in = port_.plug_in();
  plugged_in_ = plugged_in.ok();
  if (plugged_in) thread_ = std::jthread([this](const std::stop_token& stop) { play(stop); });
  return plugged_in;
}

void LivePort::play(const std::stop_token& stop) {
  while (const auto piece = source_()) {
    while (!stop.stop_requested() && clock_.now() < piece->time) clock_.wait(signal_, piece->time);
    if (stop.stop_requested()) return;
    bring(*piece);
  }
}

void LivePort::bring(const LinePiece& piece) {
  switch (piece.kind) {
    case LinePiece::Kind::kPluggedIn:
      if (!plugged_in_) plugged_in_ = port_.plug_in().ok();
      break;
    case LinePiece::Kind::kBytes:
      port_.send(piece.bytes);
      break;
    case LinePiece::Kind::kPulled:
      port_.pull();
      plugged_in_ = false;
      break;
  }
}

}  // namespace plumbline::sim
