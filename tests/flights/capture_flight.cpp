// SPDX-License-Identifier: MIT
#include "tests/flights/capture_flight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/geodesy/local_frame.h"
#include "edge/gnss/stream_decoder.h"
#include "sim/random.h"
#include "sim/replayed_receiver.h"
#include "sim/virtual_clock.h"

namespace plumbline::flights {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kExposure{1};
constexpr milliseconds kDelivery{60};

nanoseconds of_seconds(double seconds) { return nanoseconds(std::llround(seconds * 1e9)); }

class Simulation {
 public:
  explicit Simulation(const CaptureFlight& flight)
      : flight_(flight),
        random_(flight.seed, 41),
        path_(flight.path, flight.seed),
        frame_(*geodesy::LocalFrame::at({35.66, 139.76, 52.3})),
        stream_([this](double s) { return frame_.geodetic_of(path_.at(s)); }, flight.receiver,
                flight.seed),
        receiver_(clock_, gnss::make_fix_decoder, [this] { return stream_.next(); }),
        decider_(flight.options) {}

  CaptureLog run() {
    hear(capture::Started{clock_.wall().wall});
    hear(capture::CameraSeen{true});
    (void)receiver_.start([this](const ReceiverEvent& event) {
      if (const auto* fix = std::get_if<ReceivedFix>(&event)) {
        hear(capture::FixHeard{fix->fix, fix->first_byte, false});
      }
    });
    if (flight_.pulses_per_second) schedule_pulse(1);
    if (flight_.options.release.release == capture::Release::kNearestFrame) schedule_frame(0);
    clock_.run_until(HostTime{} + of_seconds(path_.duration_s()));
    receiver_.stop();
    for (const auto& entry : decider_.steps().entries()) log_.entries_taken.push_back(entry.taken);
    return std::move(log_);
  }

 private:
  HostTime host_of(double utc_s) const {
    return stream_.host_of(flight_.receiver.utc_at_start +
                           std::chrono::microseconds(std::llround(1e6 * utc_s)));
  }

  // UTC since the start; the host's clock is off by its rate alone.
  double utc_s(HostTime time) const {
    return std::chrono::duration<double>(time.time_since_epoch()).count() /
           (1 + flight_.receiver.host_rate_error);
  }

  void hear(capture::Happening what) {
    log_.inputs.push_back({clock_.now(), std::move(what)});
    const std::size_t before = log_.decisions.size();
    decider_.take(log_.inputs.back(), log_.decisions);
    for (std::size_t k = before; k < log_.decisions.size(); ++k) act(log_.decisions[k]);
    schedule_tick();
  }

  void schedule_tick() {
    const HostTime due = std::max(decider_.due(), clock_.now());
    if (due >= next_tick_ || decider_.due() == HostTime::max()) return;
    next_tick_ = due;
    clock_.at(due, [this, due] {
      if (next_tick_ != due) return;  // an earlier one was asked for since
      next_tick_ = HostTime::max();
      if (clock_.now() >= decider_.due()) {
        hear(capture::Tick{});
      } else {
        schedule_tick();
      }
    });
  }

  void act(const capture::Decision& decision) {
    if (std::holds_alternative<capture::Pulse>(decision.what)) expose();
    if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what)) {
      log_.photos.push_back(
          {*taken, path_.at(utc_s(exposures_.at(static_cast<std::size_t>(taken->frame.value()))))});
    }
    if (const auto* missed = std::get_if<capture::PhotoMissed>(&decision.what)) {
      log_.missed.push_back(*missed);
    }
    if (const auto* changed = std::get_if<capture::PhaseChanged>(&decision.what)) {
      log_.phases.push_back(changed->phase);
    }
  }

  void expose() {
    deliver(clock_.now() +
            of_seconds(flight_.camera_delay_s + flight_.camera_jitter_s * random_.normal()));
  }

  void schedule_frame(int number) {
    const double time_s = (number + 0.37) / flight_.frames_per_s;
    const HostTime middle = HostTime{} + of_seconds(time_s);
    clock_.at(middle, [this, number, middle] {
      deliver(middle);
      schedule_frame(number + 1);
    });
  }

  bool is_gone(HostTime time) const {
    const double time_s = std::chrono::duration<double>(time.time_since_epoch()).count();
    return std::any_of(
        flight_.camera_gone_s.begin(), flight_.camera_gone_s.end(),
        [&](const auto& gone) { return time_s >= gone.first && time_s < gone.second; });
  }

  void deliver(HostTime middle) {
    if (is_gone(middle)) return;
    exposures_.push_back(middle);
    capture::FrameSeen frame;
    frame.sequence = exposures_.size() - 1;
    frame.timing = {middle - kExposure / 2, kExposure, nanoseconds{},
                    std::chrono::microseconds(200)};
    frame.rows = 1;
    clock_.at(middle + kDelivery, [this, frame] { hear(frame); });
  }

  void schedule_pulse(int second) {
    const HostTime edge = host_of(second) + of_seconds(10e-6 * std::abs(random_.normal()));
    clock_.at(edge, [this, second, edge] {
      hear(capture::PulsePerSecond{edge});
      schedule_pulse(second + 1);
    });
  }

  const CaptureFlight& flight_;
  sim::Random random_;
  sim::ClimbPath path_;
  geodesy::LocalFrame frame_;
  sim::VirtualClock clock_{
      HostTime{}, std::chrono::time_point_cast<nanoseconds>(sim::GnssStreamOptions{}.utc_at_start)};
  sim::GnssStream stream_;
  sim::ReplayedReceiver receiver_;
  capture::Decider decider_;
  HostTime next_tick_ = HostTime::max();
  std::vector<HostTime> exposures_;  // middles, by sequence
  CaptureLog log_;
};

}  // namespace

CaptureLog fly(const CaptureFlight& flight) { return Simulation(flight).run(); }

}  // namespace plumbline::flights
