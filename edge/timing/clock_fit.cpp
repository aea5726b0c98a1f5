// SPDX-License-Identifier: MIT
#include "edge/timing/clock_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumbline::timing {
namespace {

constexpr std::size_t kMostDoubtful = 64;
constexpr std::uint64_t kLeastToEstimate = 3;

// One at either end may be of a part of its piece only.
std::size_t most_pieces(const ClockFitOptions& options) {
  return static_cast<std::size_t>(options.longest_window / options.piece) + 2;
}

void add_sigma(GnssClock& clock, double sigma_s) { clock.variance_s2 += sigma_s * sigma_s; }

// What a line fitted over the last `span_s` seconds does not know of a rate that changed meanwhile.
// At its end a walk of the rate leaves it off by about q T^(3/2) / sqrt(15). Below a ramp a the
// lowest line touches in the middle: off by a T^2 / 8 at its end, by a T / 2 in its slope.
void allow_for_changes_of_rate(GnssClock& clock, double span_s, double walk, double ramp) {
  const double walked = walk * walk * span_s;
  const double ramped = ramp * ramp * span_s * span_s;
  clock.variance_s2 += walked * span_s * span_s / 15 + ramped * span_s * span_s / 64;
  clock.covariance_s += walked * span_s / 8 + ramped * span_s / 16;
  clock.rate_variance += walked / 3 + ramped / 4;
  clock.rate_walk_per_sqrt_s = walk;
}

}  // namespace

ClockFit::ClockFit(const ClockFitOptions& options)
    : options_(options), earliest_(most_pieces(options)), finder_(most_pieces(options)) {
  points_.reserve(most_pieces(options));
  doubtful_.reserve(kMostDoubtful);
}

bool ClockFit::add(GpsTime epoch, HostTime first_byte) {
  const Arrival arrival{epoch, first_byte};
  ++summary_.epochs;
  const nanoseconds after_floor = behind(arrival);
  const nanoseconds bound = tolerance(arrival);
  if (after_floor > bound || after_floor < -bound) return doubt(arrival, after_floor > bound);
  doubtful_.clear();
  summary_.in_doubt = false;
  if (!earliest_.empty() && epoch <= newest_) {
    ++summary_.repeated;
    return false;
  }
  use(arrival);
  return false;
}

std::optional<GnssClock> ClockFit::estimate() const {
  if (!clock_ || used_since_start_ < kLeastToEstimate) return std::nullopt;
  GnssClock clock = *clock_;
  clock.host -= options_.latency.value;
  clock.latency = options_.latency.value;
  clock.sigma_latency = options_.latency.sigma;
  allow_for_poll(clock);
  if (last_rounded_ && newest_ - *last_rounded_ < options_.window) allow_for_rounding(clock);
  return clock;
}

// Polls that beat against the epochs leave the least latency as it is; those whose phase stands
// still add anything up to a step to it, and arrivals alone cannot tell which. A quarter of a step
// with a sigma of 0.4 covers both. At the start all stand still, for the clocks have not yet moved
// by a step against each other: the sigma is wider.
void ClockFit::allow_for_poll(GnssClock& clock) const {
  const double step_s = in_seconds(options_.poll);
  if (step_s <= 0) return;
  const double span_s = in_seconds(newest_ - earliest_.front().epoch);
  const double still = std::max(0.0, 1 - options_.rate_sigma * span_s / step_s);
  clock.host -= from_seconds(step_s / 4);
  add_sigma(clock, (0.4 + 0.2 * still) * step_s);
}

// Rounding that varies lowers the floor by its half, one that is constant shifts it by anything up
// to that: between the two.
void ClockFit::allow_for_rounding(GnssClock& clock) const {
  clock.host += options_.rounding / 4;
  add_sigma(clock, in_seconds(options_.rounding) / 3);
}

nanoseconds ClockFit::behind(const Arrival& arrival) const {
  return clock_ ? arrival.host - clock_->host_of(arrival.epoch).time : nanoseconds(0);
}

nanoseconds ClockFit::tolerance(const Arrival& arrival) const {
  return clock_ ? options_.step + 3 * clock_->host_of(arrival.epoch).sigma_fit : options_.step;
}

void ClockFit::use(const Arrival& arrival) {
  ++summary_.used;
  ++used_since_start_;
  newest_ = arrival.epoch;
  const bool rounded = arrival.epoch.time_since_epoch() % options_.exact_grid != nanoseconds(0);
  if (rounded) last_rounded_ = arrival.epoch;
  const auto piece_of = [&](const Arrival& a) {
    return a.epoch.time_since_epoch() / options_.piece;
  };
  if (earliest_.empty() || piece_of(earliest_.back()) != piece_of(arrival)) {
    earliest_.push_back(arrival);
  } else if (arrival.delay() < earliest_.back().delay()) {
    earliest_.back() = arrival;
  } else {
    return;
  }
  forget_old();
  refit();
}

void ClockFit::forget_old() {
  const auto enough = static_cast<std::size_t>(options_.window / options_.piece) / 2;
  while (earliest_.size() > 1) {
    const nanoseconds age = newest_ - earliest_.front().epoch;
    const bool old = age > options_.window && earliest_.size() > enough;
    if (!old && age <= options_.longest_window) return;
    earliest_.pop_front();
  }
}

bool ClockFit::doubt(const Arrival& arrival, bool late) {
  ++(late ? summary_.late : summary_.early);
  summary_.in_doubt = true;
  if (late != doubtful_are_late_) doubtful_.clear();
  doubtful_are_late_ = late;
  // Of many the first is kept, for how long it lasts, and the last ones, for what they say.
  if (doubtful_.size() == kMostDoubtful) doubtful_.erase(doubtful_.begin() + 1);
  doubtful_.push_back(arrival);
  if (!confirmed()) return false;
  begin_anew();
  return true;
}

bool ClockFit::confirmed() const {
  if (doubtful_.size() < static_cast<std::size_t>(options_.confirming)) return false;
  // A stalled computer or radio gives late epochs, too, but in a heap or not for long.
  const nanoseconds needed = doubtful_are_late_ ? nanoseconds(options_.late_lasts) : nanoseconds(0);
  return doubtful_.back().host - doubtful_.front().host >= needed &&
         doubtful_.back().epoch - doubtful_.front().epoch >= needed / 2;
}

void ClockFit::begin_anew() {
  const std::vector<Arrival> after = doubtful_;
  doubtful_.clear();
  const auto floor = std::min_element(after.begin(), after.end(), [](const auto& a, const auto& b) {
    return a.delay() < b.delay();
  });
  ++summary_.steps;
  summary_.last_step = behind(*floor);
  summary_.in_doubt = false;
  earliest_.clear();
  clock_.reset();
  last_rounded_.reset();
  used_since_start_ = 0;
  for (const Arrival& arrival : after) {
    if (earliest_.empty() || arrival.epoch > newest_) use(arrival);
  }
}

void ClockFit::refit() {
  const nanoseconds base = earliest_.back().delay();
  points_.clear();
  for (std::size_t k = 0; k < earliest_.size(); ++k) {
    const Arrival& arrival = earliest_[k];
    points_.push_back({in_seconds(arrival.epoch - newest_), in_seconds(arrival.delay() - base)});
  }
  const Envelope floor = finder_.find(points_, options_.rate_sigma);
  const double span_s = -points_.front().time_s;
  GnssClock clock;
  clock.gps = newest_;
  clock.host = HostTime(newest_.time_since_epoch() + base + from_seconds(floor.value_s));
  clock.rate = floor.slope;
  clock.variance_s2 = floor.variance_s2;
  clock.covariance_s = floor.covariance_s;
  clock.rate_variance = floor.slope_variance;
  allow_for_changes_of_rate(clock, span_s, options_.rate_walk_per_sqrt_s, options_.rate_ramp_per_s);
  clock_ = clock;
}

}  // namespace plumbline::timing
