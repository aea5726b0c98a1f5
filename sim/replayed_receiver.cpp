// SPDX-License-Identifier: MIT
#include "sim/replayed_receiver.h"

#include <utility>

namespace plumbline::sim {

ReplayedReceiver::ReplayedReceiver(VirtualClock& clock, MakeFixDecoder make_decoder,
                                   LineSource source, std::string name)
    : clock_(clock),
      source_(std::move(source)),
      line_(clock, std::move(make_decoder), std::move(name)) {}

Status ReplayedReceiver::start(Sink sink) {
  Status started = line_.start(std::move(sink));
  if (started) resume();
  return started;
}

void ReplayedReceiver::resume() {
  if (playing_) return;
  const auto piece = source_();
  if (!piece) return;
  playing_ = true;
  clock_.at(piece->time, [this, piece = *piece, alive = std::weak_ptr(alive_)] {
    if (alive.expired()) return;
    play(piece);
    playing_ = false;
    resume();
  });
}

void ReplayedReceiver::play(const LinePiece& piece) {
  switch (piece.kind) {
    case LinePiece::Kind::kPluggedIn:
      line_.plug_in();
      break;
    case LinePiece::Kind::kBytes:
      line_.send(piece.bytes);
      break;
    case LinePiece::Kind::kPulled:
      line_.pull();
  }
}

}  // namespace plumbline::sim
