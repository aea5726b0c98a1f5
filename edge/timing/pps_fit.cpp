// SPDX-License-Identifier: MIT
#include "edge/timing/pps_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "edge/base/median.h"

namespace plumbline::timing {
namespace {

using std::chrono::seconds;

constexpr std::size_t kMostStrays = 16;

// A stamp as a number of whole seconds after another, and what is left over.
struct Beat {
  double number = 0;
  double left_s = 0;
};

Beat beat_of(HostTime stamp, HostTime origin, double rate) {
  const double after_s = in_seconds(stamp - origin);
  const double number = std::round(after_s / (1 + rate));
  // Whole seconds are taken off as integers: a double has too few digits for both.
  const auto whole = seconds(static_cast<std::int64_t>(number));
  return {number, in_seconds(stamp - origin - whole)};
}

// Those of `stamps` that are whole seconds of `rate` away from the one at `origin`, one per second.
std::deque<HostTime> train_of(const std::deque<HostTime>& stamps, HostTime origin, double rate,
                              nanoseconds gate) {
  std::deque<HostTime> train;
  double last = -1;
  for (const HostTime stamp : stamps) {
    const Beat beat = beat_of(stamp, origin, rate);
    const bool fits = std::abs(beat.left_s - rate * beat.number) <= in_seconds(gate);
    if (stamp < origin || !fits || beat.number <= last) continue;
    last = beat.number;
    train.push_back(stamp);
  }
  return train;
}

// Weighted line through beats: left = value + rate * number.
struct LineSums {
  double w = 0, x = 0, xx = 0, y = 0, xy = 0;

  void add(const Beat& beat, double weight) {
    w += weight;
    x += weight * beat.number;
    xx += weight * beat.number * beat.number;
    y += weight * beat.left_s;
    xy += weight * beat.number * beat.left_s;
  }
  double determinant() const { return w * xx - x * x; }
  double value_s() const { return (xx * y - x * xy) / determinant(); }
  double rate() const { return (w * xy - x * y) / determinant(); }
};

double median_size(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return upper_median(std::move(values));
}

struct RobustLine {
  LineSums sums;
  double scatter_s = 0;
};

// Tukey's biweight, begun with the weights of least absolute values.
RobustLine robust_line(const std::vector<Beat>& beats, double least_scatter_s) {
  std::vector<double> weights(beats.size(), 1.0);
  std::vector<double> residuals(beats.size());
  RobustLine line;
  for (int round = 0; round < 16; ++round) {
    line.sums = {};
    for (std::size_t k = 0; k < beats.size(); ++k) line.sums.add(beats[k], weights[k]);
    for (std::size_t k = 0; k < beats.size(); ++k) {
      residuals[k] = beats[k].left_s - line.sums.value_s() - line.sums.rate() * beats[k].number;
    }
    line.scatter_s = std::max(least_scatter_s, 1.4826 * median_size(residuals));
    for (std::size_t k = 0; k < beats.size(); ++k) {
      const double size = std::abs(residuals[k]) / line.scatter_s;
      const double inside = std::max(0.0, 1 - size * size / (4.685 * 4.685));
      weights[k] = round < 8 ? 1 / std::max(1.0, size) : inside * inside;
    }
  }
  // With few pulses their scatter is itself uncertain.
  const double freedom = std::max(1.0, static_cast<double>(beats.size()) - 2);
  line.scatter_s *= std::sqrt((freedom + 4) / freedom);
  return line;
}

}  // namespace

PpsFit::PpsFit(const PpsFitOptions& options) : options_(options) {}

void PpsFit::add_edge(HostTime stamp) {
  ++summary_.edges;
  if (line_ && belongs(stamp)) {
    ++summary_.used;
    strays_.clear();
    train_.push_back(stamp);
    while (train_.size() > options_.pulses ||
           train_.back() - train_.front() > options_.longest_window) {
      train_.pop_front();
    }
    if (train_.size() >= 3) return refit();
    return begin();
  }
  ++summary_.rejected;
  strays_.push_back(stamp);
  if (strays_.size() > kMostStrays) strays_.pop_front();
  begin();
}

bool PpsFit::belongs(HostTime stamp) const {
  const Beat beat = beat_of(stamp, line_->last, line_->rate);
  const double gap_s = beat.number;
  const double walked =
      options_.rate_walk_per_sqrt_s * options_.rate_walk_per_sqrt_s * gap_s * gap_s * gap_s / 3;
  const double warmed = 0.5 * options_.rate_change_per_s * gap_s * gap_s;
  const double variance = line_->variance_s2 + 2 * line_->covariance_s * gap_s +
                          line_->rate_variance * gap_s * gap_s + walked + warmed * warmed;
  const double gate_s = in_seconds(options_.gate) + 3 * std::sqrt(variance);
  return beat.number >= 1 && gate_s < 0.1 &&
         std::abs(beat.left_s - line_->rate * beat.number) <= gate_s;
}

void PpsFit::begin() {
  std::deque<HostTime> best;
  for (std::size_t i = 0; i < strays_.size(); ++i) {
    for (std::size_t j = i + 1; j < strays_.size(); ++j) {
      const Beat beat = beat_of(strays_[j], strays_[i], 0);
      const double rate = beat.left_s / std::max(1.0, beat.number);
      if (beat.number < 1 || std::abs(rate) > options_.rate_limit) continue;
      auto train = train_of(strays_, strays_[i], rate, options_.gate);
      if (train.size() > best.size()) best = std::move(train);
    }
  }
  if (best.size() < static_cast<std::size_t>(options_.confirming)) return;
  if (line_) ++summary_.restarts;
  summary_.used += best.size();
  summary_.rejected -= best.size();
  train_ = std::move(best);
  strays_.clear();
  line_ = Line{train_.front(), 0, 0, 0, 0};
  refit();
}

void PpsFit::refit() {
  const HostTime origin = train_.back();
  std::vector<Beat> beats;
  for (const HostTime stamp : train_) beats.push_back(beat_of(stamp, origin, line_->rate));
  const RobustLine fit = robust_line(beats, in_seconds(options_.least_scatter));
  const double scatter2 = fit.scatter_s * fit.scatter_s / fit.sums.determinant();
  // A line through a parabola of curvature c is off by c T^2 / 12 and c T / 2 at its end.
  const double span_s = -beats.front().number;
  const double bent_s = options_.rate_change_per_s * span_s * span_s / 12;
  const double bent_rate = options_.rate_change_per_s * span_s / 2;
  Line line;
  line.last = origin + from_seconds(fit.sums.value_s());
  line.rate = fit.sums.rate();
  line.variance_s2 = scatter2 * fit.sums.xx + bent_s * bent_s;
  line.covariance_s = -scatter2 * fit.sums.x + bent_s * bent_rate;
  line.rate_variance = scatter2 * fit.sums.w + bent_rate * bent_rate;
  line_ = line;
  summary_.scatter = from_seconds(fit.scatter_s);
}

std::optional<nanoseconds> PpsFit::measured_latency(const std::optional<GnssClock>& coarse) const {
  if (!line_ || !coarse) return std::nullopt;
  const nanoseconds shown = coarse->gps_of(line_->last - delay()).time.time_since_epoch();
  return coarse->latency - (shown - std::chrono::round<seconds>(shown));
}

PpsState PpsFit::state(const std::optional<GnssClock>& coarse) const {
  if (!line_) return PpsState::kNoPulses;
  const auto latency = measured_latency(coarse);
  if (!latency) return PpsState::kUnnumbered;
  const bool possible = *latency >= options_.least_latency && *latency <= options_.most_latency;
  return possible ? PpsState::kLocked : PpsState::kWrongEdge;
}

std::optional<GnssClock> PpsFit::estimate(const std::optional<GnssClock>& coarse) const {
  if (state(coarse) != PpsState::kLocked) return std::nullopt;
  GnssClock clock;
  clock.host = line_->last - delay();
  clock.gps = std::chrono::round<seconds>(coarse->gps_of(clock.host).time);
  clock.rate = line_->rate;
  clock.variance_s2 = line_->variance_s2;
  clock.covariance_s = line_->covariance_s;
  clock.rate_variance = line_->rate_variance;
  clock.rate_walk_per_sqrt_s = options_.rate_walk_per_sqrt_s;
  clock.sigma_latency =
      from_seconds(std::hypot(in_seconds(options_.interrupt_sigma), in_seconds(summary_.scatter)));
  clock.from_pulses = true;
  return clock;
}

}  // namespace plumbline::timing
