// SPDX-License-Identifier: MIT
#include "edge/capture/decider.h"

#include <algorithm>

namespace plumbline::capture {
namespace {

constexpr nanoseconds kLookEvery = std::chrono::milliseconds(100);  // in flight
constexpr nanoseconds kTestEvery = std::chrono::seconds(1);
// A flight that was interrupted for longer is over.
constexpr auto kSameFlight = std::chrono::minutes(20);
// After a restart the ground is taken to be where it was only for as long: then the drone may have
// been carried elsewhere.
constexpr auto kSameGround = std::chrono::seconds(90);
// An aim whose instant has just gone by is still the same one.
constexpr nanoseconds kJustGoneBy = std::chrono::milliseconds(400);

NavigatorOptions navigator_options(const CaptureOptions& options) {
  NavigatorOptions navigator;
  navigator.clock.latency = options.receiver_latency;
  navigator.reckon_for = options.plan.reckon_for;
  return navigator;
}

template <class... Cases>
struct Match : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Match(Cases...) -> Match<Cases...>;

}  // namespace

Decider::Decider(const CaptureOptions& options)
    : options_(options),
      navigator_(navigator_options(options)),
      take_off_(options.take_off),
      steps_(options.plan),
      stillness_(options.stillness),
      pulses_(options.release) {}

void Decider::take(const Input& input, std::vector<Decision>& decisions) {
  now_ = std::max(now_, input.now);
  hear(now_, input.what, decisions);
  look_at_phase(decisions);
  if (phase_ == Phase::kFlying) follow_ground(decisions);
  if (phase_ == Phase::kFlying) work(decisions);
  if (phase_ == Phase::kReady) test(decisions);
}

void Decider::hear(HostTime now, const Happening& what, std::vector<Decision>& decisions) {
  std::visit(Match{[&](const Started& started) { navigator_.set_wall(started.wall, now); },
                   [&](const Resumed& resumed) { resume(resumed); },
                   [&](const FixHeard& heard) { hear_fix(now, heard); },
                   [&](const PulsePerSecond& pulse) { navigator_.add_pulse(pulse.edge); },
                   [&](const FrameSeen& frame) { hear_frame(frame, decisions); },
                   [&](const CameraSeen& camera) {
                     streaming_ = camera.streaming;
                     if (!streaming_) frames_.camera_left();
                   },
                   [&](const ShutterOpened& opened) {
                     if (const auto exposure = pulses_.see(opened)) close(*exposure, decisions);
                   },
                   [&](const PilotSeen& pilot) { take_off_.set_armed(pilot.armed); },
                   [&](const PilotHeightSeen& height) {
                     take_off_.add(PilotHeight{now, height.above_arming_m, height.climb_m_s});
                   },
                   [&](const PhotoLost& lost) { hear_lost(lost, decisions); }, [](const Tick&) {}},
             what);
}

void Decider::resume(const Resumed& resumed) {
  resumed_ = resumed.flying;
  ground_is_of_before_ = !resumed.flying;
  resumed_last_fix_ = resumed.last_fix;
  const bool a_moment_ago = resumed.last_seen && now_ - *resumed.last_seen < kSameFlight;
  if (resumed.flying && a_moment_ago) blind_from_ = now_ + options_.plan.reckon_for;
  take_off_.resume(resumed.ground_height_m);
  steps_.resume(resumed.taken);
  last_number_ = resumed.photos;
}

void Decider::hear_fix(HostTime now, const FixHeard& heard) {
  jumped_ = heard.jumped;
  if (!navigator_.add(heard.fix, heard.first_byte)) return;
  const auto here = navigator_.at(now);
  if (!here || here->reckoned) return;
  take_off_.add({now, here->height_ellipsoidal_m, here->sigma_height_m(), here->climb_m_s()});
  stillness_.add(*here);
}

void Decider::hear_frame(const FrameSeen& frame, std::vector<Decision>& decisions) {
  if (!by_pulse()) {
    frames_.see(frame);
  } else if (const auto exposure = pulses_.see(frame)) {
    close(*exposure, decisions);
  }
}

// Its height is open again, and gone by.
void Decider::hear_lost(const PhotoLost& lost, std::vector<Decision>& decisions) {
  for (std::size_t k = 0; k < newest_.size(); ++k) {
    if (newest_[k].number != lost.number) continue;
    steps_.set_taken(newest_[k].target.entry, false);
    decisions.push_back({now_, newest_[k]});
  }
}

void Decider::look_at_ground() {
  const auto here = navigator_.at(now_);
  const auto fix = navigator_.last_fix();
  if (!ground_is_of_before_ || !here || !fix) return;
  ground_is_of_before_ = false;
  const bool same = resumed_last_fix_ && *fix - *resumed_last_fix_ <= kSameGround;
  if (!same) take_off_.resume(here->height_ellipsoidal_m);
}

void Decider::look_at_phase(std::vector<Decision>& decisions) {
  look_at_ground();
  const bool placed = navigator_.at(now_).has_value();
  if (phase_ == Phase::kWaiting && resumed_ && placed) {
    const auto fix = navigator_.last_fix();
    const bool stale = resumed_last_fix_ && fix && *fix - *resumed_last_fix_ > kSameFlight;
    change_phase(stale ? Phase::kLanded : Phase::kFlying, decisions);
  }
  // A drone that was in the air a moment ago still is, whatever has become of its receiver.
  if (phase_ == Phase::kWaiting && blind_from_ && now_ >= *blind_from_) {
    change_phase(Phase::kFlying, decisions);
  }
  if (phase_ == Phase::kWaiting && placed && (streaming_ || by_pulse())) {
    change_phase(Phase::kReady, decisions);
  }
  const bool on_ground = phase_ == Phase::kWaiting || phase_ == Phase::kReady;
  if (on_ground && take_off_.has_taken_off(now_)) change_phase(Phase::kFlying, decisions);
  if (phase_ == Phase::kFlying && take_off_.has_landed(now_)) {
    change_phase(Phase::kLanded, decisions);
  }
}

void Decider::change_phase(Phase phase, std::vector<Decision>& decisions) {
  phase_ = phase;
  if (phase == Phase::kFlying) {
    aim_state_.ground_height_m = take_off_.ground_height_m();
    ground_is_final_ = resumed_ || options_.take_off.by == TakeOffBy::kHeight;
    aim_state_.flying_since = now_;
    pulses_.give_up();
    stillness_.reset();
  }
  decisions.push_back({now_, PhaseChanged{phase, take_off_.ground_height_m()}});
}

// A flight that the autopilot began may stand on the ground for a while, or have left it without a
// position. The first position then is that of the ground, unless the autopilot says how high it
// is.
void Decider::follow_ground(std::vector<Decision>& decisions) {
  if (ground_is_final_) return;
  const auto here = navigator_.at(now_);
  if (!here || !take_off_.ground_height_m()) return;
  const bool is_new = !aim_state_.ground_height_m;
  const auto above_m = take_off_.above_arming_m(now_);
  if (is_new && above_m) take_off_.resume(here->height_ellipsoidal_m - *above_m);
  aim_state_.ground_height_m = take_off_.ground_height_m();
  ground_is_final_ = take_off_.is_high();
  if (is_new || ground_is_final_) {
    decisions.push_back({now_, GroundFound{*aim_state_.ground_height_m}});
  }
}

// The delay is learned on the ground, where nobody waits for the photo.
void Decider::test(std::vector<Decision>& decisions) {
  if (!by_pulse() || !options_.release.is_answered || tests_ >= options_.release.test_pulses)
    return;
  if (pulses_.is_missed(now_)) pulses_.give_up();
  if (now_ < next_test_ || pulses_.is_waiting()) return;
  ++tests_;
  next_test_ = now_ + kTestEvery;
  pulses_.pulsed(now_);
  decisions.push_back({now_, Pulse{0}});
}

void Decider::work(std::vector<Decision>& decisions) {
  next_look_ = now_ + kLookEvery;
  if (aim_ && by_pulse()) {
    if (const auto exposure = pulses_.assumed(now_)) close(*exposure, decisions);
  }
  if (aim_ && !by_pulse()) {
    if (const auto exposure = frames_.take(now_)) close(*exposure, decisions);
  }
  if (aim_ && (by_pulse() ? pulses_.is_missed(now_) : frames_.is_missed(now_))) miss(decisions);
  if (pulses_.is_waiting()) return;
  re_aim(decisions);
  if (by_pulse()) pulse_if_due(decisions);
}

// Of a height that is aimed at and has just gone by, if the drone has not turned back before it:
// the instant at which it went by, as it is known now.
std::optional<Aim> Decider::just_gone_by(HostTime earliest) const {
  if (!aim_ || aim_->target.reason != Reason::kHeight || aim_->instant > earliest + kJustGoneBy) {
    return std::nullopt;
  }
  const HostTime from = std::min(aim_->instant, earliest) - kJustGoneBy;
  const auto again =
      next_aim(options_.plan, steps_, navigator_, aim_state_, options_.stillness, from);
  if (!again || again->target.entry != aim_->target.entry || again->instant > earliest) {
    return std::nullopt;
  }
  return again;
}

// What has gone by, as the drone will be at that time.
void Decider::look_at_heights(HostTime time, std::vector<Decision>& decisions) {
  const auto then = navigator_.at(time);
  if (!then || !aim_state_.ground_height_m) return;
  const double height_m = then->height_ellipsoidal_m - *aim_state_.ground_height_m;
  steps_.look(height_m);
  for (;;) {
    const int entry = steps_.left_behind(height_m, aim_ ? aim_->target.entry : -1);
    if (entry < 0) return;
    const double left_m = steps_.entries()[static_cast<std::size_t>(entry)].height_m;
    decisions.push_back({now_, HeightPassed{{Reason::kHeight, entry, left_m}}});
  }
}

void Decider::re_aim(std::vector<Decision>& decisions) {
  aim_state_.time_to_stop_waiting = stillness_.is_time(now_);
  aim_state_.at_rest = stillness_.is_still(now_);
  if (!streaming_ && !by_pulse()) {
    aim_.reset();
    look_at_heights(now_, decisions);
  } else {
    const HostTime earliest = by_pulse() ? now_ + pulses_.delay() : now_;
    auto gone = just_gone_by(earliest);
    if (!gone) look_at_heights(earliest, decisions);
    aim_ = gone ? gone
                : next_aim(options_.plan, steps_, navigator_, aim_state_, options_.stillness,
                           earliest);
  }
  if (by_pulse()) return;
  if (aim_) {
    frames_.aim(aim_->instant);
  } else {
    frames_.forget();
  }
}

void Decider::pulse_if_due(std::vector<Decision>& decisions) {
  if (!aim_ || now_ < aim_->instant - pulses_.delay()) return;
  pulses_.pulsed(now_);
  steps_.set_taken(aim_->target.entry, true);
  decisions.push_back({now_, Pulse{++last_number_}});
}

void Decider::close(const Exposure& exposure, std::vector<Decision>& decisions) {
  if (phase_ != Phase::kFlying || !aim_) return;  // a test
  PhotoTaken taken;
  taken.number = by_pulse() ? last_number_ : ++last_number_;
  taken.target = aim_->target;
  taken.frame = exposure.frame;
  taken.wanted = aim_->instant;
  taken.exposed = exposure.middle;
  taken.exposed_sigma = exposure.sigma;
  taken.place = place_at(exposure.middle);
  taken.marks = marks_of(taken.place);
  steps_.set_taken(aim_->target.entry, true);
  aim_state_.last_photo = exposure.middle;
  aim_state_.last_place_m.reset();
  if (taken.place) aim_state_.last_place_m = taken.place->in_enu_m.head<2>();
  if (aim_->target.reason == Reason::kAside) ++aim_state_.aside_taken;
  aim_.reset();
  newest_.push_back({taken.number, taken.target, taken.wanted});
  decisions.push_back({now_, std::move(taken)});
}

void Decider::miss(std::vector<Decision>& decisions) {
  const int number = by_pulse() ? last_number_ : 0;
  steps_.set_taken(aim_->target.entry, false);
  decisions.push_back({now_, PhotoMissed{number, aim_->target, aim_->instant}});
  pulses_.give_up();
  frames_.forget();
  aim_.reset();
}

std::optional<Place> Decider::place_at(HostTime time) const {
  const auto motion = navigator_.at(time);
  if (!motion || !aim_state_.ground_height_m) return std::nullopt;
  return Place{motion->in_enu_m,     motion->covariance_m2,
               motion->velocity_m_s, motion->height_ellipsoidal_m - *aim_state_.ground_height_m,
               motion->quality,      motion->age};
}

Marks Decider::marks_of(const std::optional<Place>& place) const {
  const auto motion = navigator_.at(now_);
  Marks marks;
  marks.late = aim_->late;
  marks.still = aim_->still;
  marks.no_position = !place;
  marks.reckoned = place && (!motion || motion->reckoned);
  marks.not_fixed = place && place->quality != FixQuality::kFixed;
  marks.jumped = jumped_ || navigator_.has_jumped();
  marks.resumed = resumed_;
  return marks;
}

HostTime Decider::due() const {
  if (phase_ == Phase::kReady && by_pulse() && tests_ < options_.release.test_pulses) {
    return std::min(pulses_.due(), pulses_.is_waiting() ? HostTime::max() : next_test_);
  }
  if (phase_ == Phase::kWaiting && blind_from_) return *blind_from_;
  if (phase_ != Phase::kFlying) return HostTime::max();
  if (pulses_.is_waiting()) return std::min(pulses_.due(), next_look_);
  HostTime due = std::min(next_look_, frames_.due());
  if (aim_ && by_pulse()) due = std::min(due, aim_->instant - pulses_.delay());
  return due;
}

bool Decider::holds(std::uint64_t sequence) const { return frames_.holds(sequence); }

}  // namespace plumbline::capture
