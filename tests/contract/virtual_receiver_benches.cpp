// SPDX-License-Identifier: MIT
#include "tests/contract/virtual_receiver_benches.h"

#include <deque>

#include "edge/gnss/stream_decoder.h"
#include "sim/replayed_receiver.h"
#include "sim/sim_receiver.h"

namespace plumbline::contract {
namespace {

using sim::LinePiece;

class VirtualBench : public ReceiverBench {
 public:
  ReceiverEvents& events() override { return events_; }
  HostTime now() override { return clock_.now(); }
  void pass(std::chrono::nanoseconds time) override { clock_.run_until(clock_.now() + time); }

 protected:
  sim::VirtualClock clock_;
  ReceiverEvents events_;
};

class SimulatedBench : public VirtualBench {
 public:
  GnssReceiver& receiver() override { return receiver_; }
  void plug_in() override { receiver_.plug_in(); }
  void pull() override { receiver_.pull(); }
  void send(std::string_view bytes) override { receiver_.send(bytes); }

 private:
  sim::SimReceiver receiver_{clock_, gnss::make_fix_decoder};
};

class ReplayedBench : public VirtualBench {
 public:
  GnssReceiver& receiver() override { return receiver_; }
  void plug_in() override { add(LinePiece::Kind::kPluggedIn, {}); }
  void pull() override { add(LinePiece::Kind::kPulled, {}); }
  void send(std::string_view bytes) override { add(LinePiece::Kind::kBytes, bytes); }
  void pass(std::chrono::nanoseconds time) override {
    if (started_) receiver_.resume();
    VirtualBench::pass(time);
    started_ = true;
  }

 private:
  void add(LinePiece::Kind kind, std::string_view bytes) {
    recording_.push_back({clock_.now(), kind, std::string(bytes)});
  }

  std::optional<LinePiece> next() {
    if (recording_.empty()) return std::nullopt;
    LinePiece piece = recording_.front();
    recording_.pop_front();
    return piece;
  }

  std::deque<LinePiece> recording_;
  bool started_ = false;
  sim::ReplayedReceiver receiver_{clock_, gnss::make_fix_decoder, [this] { return next(); }};
};

}  // namespace

std::unique_ptr<ReceiverBench> make_simulated_receiver_bench() {
  return std::make_unique<SimulatedBench>();
}

std::unique_ptr<ReceiverBench> make_replayed_receiver_bench() {
  return std::make_unique<ReplayedBench>();
}

}  // namespace plumbline::contract
