// SPDX-License-Identifier: MIT
#include "tests/soak/companion.h"

#include <cmath>
#include <cstdlib>
#include <utility>
#include <variant>

#include "edge/gnss/antenna_track.h"
#include "edge/gnss/leap_seconds.h"
#include "edge/gnss/stream_decoder.h"
#include "tests/soak/day.h"

namespace plumbline::soak {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

double in_seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

// How high the antenna truly was, by the receiver's own time.
double true_height_m(UtcTime time) {
  return place_at(in_seconds(time - sim::GnssStreamOptions().utc_at_start)).height_ellipsoidal_m;
}

}  // namespace

Companion::Companion(sim::VirtualClock& clock, Storage& disk, int hours)
    : clock_(clock),
      disk_(disk),
      stream_(place_at, stream_options(hours), 1),
      receiver_(clock, gnss::make_fix_decoder),
      camera_(clock, camera_options()) {}

Status Companion::switch_on() {
  say_on();
  const Status receiving = receiver_.start([this](const ReceiverEvent& event) { take(event); });
  if (!receiving) return receiving;
  return camera_.start({}, [this](CameraEvent event) { take(std::move(event)); });
}

void Companion::live_an_hour() {
  const HostTime end = clock_.now() + std::chrono::hours(1);
  open_flight();
  schedule_troubles();
  clock_.run_until(end);
  line_.reset();
  log_.reset();
  clear_the_disk();
  ring_.clear();  // two frames lie in one block of a deque or in two, by where it stands
}

void Companion::say_on() {
  const sim::LinePiece piece = stream_.next();
  clock_.at(piece.time, [this, piece] {
    if (piece.kind == sim::LinePiece::Kind::kPluggedIn) receiver_.plug_in();
    receiver_.send(piece.bytes);
    say_on();
  });
}

void Companion::take(const ReceiverEvent& event) {
  if (const auto* received = std::get_if<ReceivedFix>(&event)) take(*received);
  if (std::holds_alternative<ReceiverReport>(event)) ++tally_.receiver_reports;
}

void Companion::take(const ReceivedFix& received) {
  if (!received.fix.time || !gnss::is_position(received.fix)) return;
  const auto epoch = gnss::gps_of(*received.fix.time);
  if (!epoch) return;
  ++tally_.fixes;
  const auto& stated_m2 = received.fix.covariance_enu_m2;
  const double sigma_m = stated_m2 ? std::sqrt((*stated_m2)(2, 2)) : 1.0;
  const double off_m = *received.fix.height_ellipsoidal_m - true_height_m(*received.fix.time);
  tally_.wrong_fixes += std::abs(off_m) > 10 * sigma_m ? 1 : 0;
  fit_.add(*epoch, received.first_byte);
  antenna_.add(received.fix);
  foresee(*epoch);
}

// One photo for each rise.
void Companion::foresee(GpsTime newest) {
  const auto fit = fit_.estimate();
  if (!fit || (last_shot_ && clock_.now() - *last_shot_ < seconds(30))) return;
  const auto now = antenna_.at(newest);
  if (!now || now->velocity_enu_m_s.z() <= 0) return;
  const double until_s =
      (kWantedHeight_m - now->position.height_ellipsoidal_m) / now->velocity_enu_m_s.z();
  if (until_s < 0 || until_s > 0.45) return;
  const auto until = std::chrono::nanoseconds(std::llround(1e9 * until_s));
  shoot(fit->host_of(newest + until).time);
}

void Companion::shoot(HostTime instant) {
  last_shot_ = instant;
  ring_.want(instant);
  clock_.at(instant, [this] {
    if (!line_->pulse()) std::abort();
    line_->drive(clock_.now() + milliseconds(5), true);
    line_->drive(clock_.now() + milliseconds(15), false);
  });
}

void Companion::take(CameraEvent event) {
  if (auto* frame = std::get_if<Frame>(&event)) {
    ++tally_.frames;
    const HostTime middle = frame->timing.middle_of_row(0.5 * (frame->image->height_px - 1));
    const auto period = last_frame_ ? middle - *last_frame_ : milliseconds(100);
    last_frame_ = middle;
    ring_.push({middle, period}, std::move(*frame));
    if (const auto taken = ring_.take(clock_.now())) store(taken->first.middle, taken->second);
  } else if (const auto* lost = std::get_if<FramesLost>(&event)) {
    tally_.frames_lost += lost->count;
  } else if (std::holds_alternative<CameraReport>(event)) {
    ++tally_.camera_reports;
  }
}

void Companion::store(HostTime middle, const Frame& frame) {
  judge_place(middle);
  const std::string name = "photo" + std::to_string(++photo_);
  const std::string bytes(frame.image->bytes.begin(), frame.image->bytes.end());
  const bool stored =
      publish(disk_, name, bytes).ok() && log_->append(name).ok() && log_->sync().ok();
  ++(stored ? tally_.photos : tally_.unstored);
}

void Companion::judge_place(HostTime middle) {
  const auto fit = fit_.estimate();
  const auto place = fit ? antenna_.at(middle, *fit) : std::nullopt;
  if (!place) {
    ++tally_.unplaced;
    return;
  }
  const double rate = stream_options(0).host_rate_error;
  const double true_m =
      place_at(in_seconds(middle.time_since_epoch()) / (1 + rate)).height_ellipsoidal_m;
  const double stamp_m = place->velocity_enu_m_s.z() * in_seconds(camera_options().sigma_stamp);
  const double sigma_m = std::hypot(std::sqrt(place->covariance_enu_m2(2, 2)),
                                    place->latency_shift_enu_m.z(), stamp_m);
  const double off_m = place->position.height_ellipsoidal_m - true_m;
  tally_.misplaced += std::abs(off_m) > 5 * sigma_m ? 1 : 0;
}

// All on a way down, when no photo is wanted.
void Companion::schedule_troubles() {
  const auto at = [this](int minute, int second, auto trouble) {
    clock_.at(clock_.now() + minutes(minute) + seconds(second), std::move(trouble));
  };
  at(40, 35, [this] { receiver_.pull(); });
  at(40, 45, [this] { receiver_.plug_in(); });
  at(45, 35, [this] { camera_.unplug(); });
  at(45, 40, [this] { camera_.plug_in(); });
  at(50, 35, [this] { camera_.silence(true); });
  at(50, 40, [this] { camera_.silence(false); });
  at(55, 35, [this] { camera_.break_stream(); });
  at(57, 35, [this] {
    const Status refused = publish(disk_, "no_such_folder/photo", "bytes");
    tally_.last_fault = refused ? "" : refused.error().sentence;
  });
}

void Companion::open_flight() {
  photo_ = 0;
  line_ = std::make_unique<sim::SimTriggerLine>(clock_, milliseconds(10), 1, line_faults());
  const Status listening = line_->listen([this](const LineEvent& event) {
    if (std::holds_alternative<LineEdge>(event)) ++tally_.edges;
    if (const auto* lost = std::get_if<EdgesLost>(&event)) tally_.edges_lost += lost->count;
  });
  auto log = disk_.create("log");
  if (!listening || !log) std::abort();
  log_ = std::move(*log);
}

void Companion::clear_the_disk() {
  const auto names = disk_.list("");
  if (!names) std::abort();
  for (const std::string& name : *names) {
    if (!disk_.remove(name)) std::abort();
  }
  if (!disk_.sync_folder("")) std::abort();
}

}  // namespace plumbline::soak
