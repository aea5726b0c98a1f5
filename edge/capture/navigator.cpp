// SPDX-License-Identifier: MIT
#include "edge/capture/navigator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/gnss/antenna_track.h"
#include "edge/gnss/leap_seconds.h"

namespace plumbline::capture {
namespace {

constexpr double kJump_m = 1;      // at the least
constexpr double kJumpSigmas = 6;  // and beyond what is known
constexpr double kAnywhere_m = 100;

Motion later(const Motion& last, HostTime time) {
  Motion motion = last;
  const double seconds = in_seconds(time - last.time);
  motion.time = time;
  motion.in_enu_m += last.velocity_m_s * seconds;
  motion.height_ellipsoidal_m += last.climb_m_s() * seconds;
  // What a drone may have changed its velocity by meanwhile: a metre per second, each second.
  motion.covariance_m2 += std::pow(seconds, 3) / 3 * Eigen::Matrix3d::Identity();
  motion.age += time - last.time;
  motion.reckoned = true;
  return motion;
}

}  // namespace

double Motion::sigma_height_m() const { return std::sqrt(covariance_m2(2, 2)); }

Navigator::Navigator(const NavigatorOptions& options)
    : options_(options), arrivals_(options.clock), predictor_(options.predictor) {}

GnssFix Navigator::dated(const GnssFix& fix, HostTime first_byte) const {
  if (fix.time || !fix.time_of_day || !wall_minus_host_) return fix;
  const std::chrono::sys_time<nanoseconds> wall(first_byte.time_since_epoch() + *wall_minus_host_);
  GnssFix whole = fix;
  const auto day = std::chrono::round<std::chrono::days>(wall - *fix.time_of_day);
  whole.time = day + *fix.time_of_day;
  return whole;
}

bool Navigator::add(const GnssFix& said, HostTime first_byte) {
  const GnssFix fix = dated(said, first_byte);
  const auto epoch = fix.time ? gnss::gps_of(*fix.time) : std::nullopt;
  if (!epoch) return false;
  arrivals_.add(*epoch, first_byte);
  refit();
  const std::optional<Motion> foreseen = foreseen_at(*epoch);
  const bool used = predictor_.add(fix);
  if (!used || !clock_) return false;
  follow_height(*epoch, fix);
  last_fix_ = fix.time;
  if (!frame_) {
    const auto frame =
        geodesy::LocalFrame::at({*fix.latitude_deg, *fix.longitude_deg, *fix.height_ellipsoidal_m});
    if (frame) frame_ = *frame;
  }
  // A microsecond later: to and fro between the clocks rounds, and before the first there is none.
  last_ = known_at(clock_->host_of(*epoch).time + std::chrono::microseconds(1));
  follow_jumps(foreseen);
  return last_.has_value();
}

std::optional<Motion> Navigator::foreseen_at(GpsTime epoch) const {
  return clock_ ? at(clock_->host_of(epoch).time) : std::nullopt;
}

// The predictor leaves single wrong positions out, and begins anew where they agree.
void Navigator::follow_jumps(const std::optional<Motion>& foreseen) {
  const bool begun = std::exchange(begun_anew_, predictor_.summary().restarts) != begun_anew_;
  if (!begun || !foreseen || !last_) return;
  const Eigen::Vector3d off_m = last_->in_enu_m - foreseen->in_enu_m;
  const double sigma_m = std::sqrt((last_->covariance_m2 + foreseen->covariance_m2).trace());
  if (off_m.norm() > std::max(kJump_m, kJumpSigmas * sigma_m)) jumped_m_ += off_m;
}

bool Navigator::has_jumped() const { return jumped_m_.norm() > kJump_m; }

void Navigator::follow_height(GpsTime epoch, const GnssFix& fix) {
  const double height_m = *fix.height_ellipsoidal_m;
  const double before_m2 = std::exchange(
      stated_m2_, fix.covariance_enu_m2 ? (*fix.covariance_enu_m2)(2, 2)
                                        : std::pow(gnss::usual_sigma_enu_m(fix.quality).z(), 2));
  const bool begins = !newest_ || epoch - *newest_ > options_.predictor.longest_gap;
  if (begins) {
    heights_.begin(height_m, stated_m2_);
  } else {
    if (fix.quality != newest_quality_) heights_.unsettle(before_m2 + stated_m2_);
    // The position has jumped: the climb goes on.
    if (predictor_.summary().restarts != restarts_) heights_.unsettle(kAnywhere_m * kAnywhere_m);
    heights_.add(in_seconds(epoch - *newest_), height_m, stated_m2_);
  }
  newest_ = epoch;
  newest_quality_ = fix.quality;
  restarts_ = predictor_.summary().restarts;
}

void Navigator::add_pulse(HostTime edge) {
  pulses_.add_edge(edge);
  refit();
}

void Navigator::hear(const Input& input) {
  if (const auto* started = std::get_if<Started>(&input.what)) {
    set_wall(started->wall, input.now);
  } else if (const auto* heard = std::get_if<FixHeard>(&input.what)) {
    (void)add(heard->fix, heard->first_byte);
  } else if (const auto* pulse = std::get_if<PulsePerSecond>(&input.what)) {
    add_pulse(pulse->edge);
  }
}

void Navigator::refit() {
  clock_ = arrivals_.estimate();
  if (!clock_) return;
  if (const auto by_pulses = pulses_.estimate(*clock_)) clock_ = by_pulses;
}

std::optional<Motion> Navigator::known_at(HostTime time) const {
  if (!clock_ || !frame_) return std::nullopt;
  const auto antenna = predictor_.at(time, *clock_);
  if (!antenna) return std::nullopt;
  Motion motion;
  motion.time = time;
  motion.in_enu_m = frame_->enu_of(antenna->position);
  motion.velocity_m_s = antenna->velocity_enu_m_s;
  motion.latency_shift_m = antenna->latency_shift_enu_m;
  motion.covariance_m2 =
      antenna->covariance_enu_m2 + motion.latency_shift_m * motion.latency_shift_m.transpose();
  motion.height_ellipsoidal_m = antenna->position.height_ellipsoidal_m;
  if (antenna->ahead > nanoseconds{}) {
    const auto foreseen = heights_.after(in_seconds(antenna->ahead));
    motion.in_enu_m.z() += foreseen->height_m - motion.height_ellipsoidal_m;
    motion.velocity_m_s.z() = foreseen->climb_m_s;
    motion.covariance_m2(2, 2) =
        foreseen->variance_m2 + stated_m2_ + std::pow(motion.latency_shift_m.z(), 2);
    motion.height_ellipsoidal_m = foreseen->height_m;
  }
  motion.quality = antenna->quality;
  motion.age = antenna->ahead;
  motion.reckoned = antenna->ahead > options_.fresh;
  return motion;
}

std::optional<Motion> Navigator::at(HostTime time) const {
  if (last_ && time - last_->time > options_.fresh) {
    if (time - last_->time > options_.reckon_for) return std::nullopt;
    return later(*last_, time);
  }
  return known_at(time);
}

}  // namespace plumbline::capture
