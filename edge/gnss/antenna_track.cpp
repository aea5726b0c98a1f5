// SPDX-License-Identifier: MIT
#include "edge/gnss/antenna_track.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::gnss {
namespace {

double seconds_between(UtcTime from, UtcTime to) {
  return std::chrono::duration<double>(to - from).count();
}

// Larger is worse.
int badness(FixQuality quality) {
  switch (quality) {
    case FixQuality::kFixed:
      return 0;
    case FixQuality::kFloat:
      return 1;
    case FixQuality::kDifferential:
      return 2;
    case FixQuality::kPps:
      return 3;
    case FixQuality::kSingle:
      return 4;
    default:
      return 5;
  }
}

AntennaTrack::Epoch epoch_of(const GnssFix& fix) {
  const Eigen::Vector3d usual = usual_sigma_enu_m(fix.quality);
  const Eigen::Matrix3d assumed = usual.cwiseAbs2().asDiagonal();
  return {*fix.time,
          {*fix.latitude_deg, *fix.longitude_deg, *fix.height_ellipsoidal_m},
          fix.covariance_enu_m2.value_or(assumed),
          fix.quality,
          !fix.covariance_enu_m2.has_value()};
}

// What a chord of that duration misses of an acceleration of 1 m/s2: (t - t0)(t1 - t) / 2.
double chord_error_s2(double span_s, double share) {
  return 0.5 * share * (1 - share) * span_s * span_s;
}

// Value and slope at `t` of the cubic through four points (Lagrange).
struct Cubic {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};

Cubic cubic_through(const std::array<double, 4>& times_s,
                    const std::array<Eigen::Vector3d, 4>& points, double t_s) {
  Cubic cubic;
  for (std::size_t j = 0; j < 4; ++j) {
    double weight = 1;
    double weight_slope = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == j) continue;
      const double span = times_s[j] - times_s[k];
      weight_slope = (weight_slope * (t_s - times_s[k]) + weight) / span;
      weight *= (t_s - times_s[k]) / span;
    }
    cubic.value += weight * points[j];
    cubic.slope += weight_slope * points[j];
  }
  return cubic;
}

}  // namespace

Eigen::Vector3d usual_sigma_enu_m(FixQuality quality) {
  switch (quality) {
    case FixQuality::kFixed:
      return {0.01, 0.01, 0.02};
    case FixQuality::kFloat:
      return {0.3, 0.3, 0.6};
    case FixQuality::kDifferential:
      return {0.6, 0.6, 1.2};
    default:
      return {3.0, 3.0, 6.0};
  }
}

bool is_position(const GnssFix& fix) {
  return badness(fix.quality) < 5 && fix.latitude_deg && fix.longitude_deg &&
         fix.height_ellipsoidal_m;
}

AntennaTrack AntennaTrack::from(const std::vector<GnssFix>& fixes, const TrackOptions& options) {
  AntennaTrack track;
  track.options_ = options;
  for (const GnssFix& fix : fixes) {
    if (is_position(fix) && fix.time) track.epochs_.push_back(epoch_of(fix));
  }
  const auto earlier = [](const Epoch& a, const Epoch& b) { return a.time < b.time; };
  const auto same_time = [](const Epoch& a, const Epoch& b) { return a.time == b.time; };
  std::stable_sort(track.epochs_.begin(), track.epochs_.end(), earlier);
  track.epochs_.erase(std::unique(track.epochs_.begin(), track.epochs_.end(), same_time),
                      track.epochs_.end());
  if (track.epochs_.empty()) return track;
  const auto frame = geodesy::LocalFrame::at(track.epochs_.front().position);
  if (!frame) {
    track.epochs_.clear();
    return track;
  }
  track.frame_ = *frame;
  for (const Epoch& epoch : track.epochs_) track.enu_m_.push_back(frame->enu_of(epoch.position));
  return track;
}

std::optional<AntennaState> AntennaTrack::at(UtcTime time) const {
  if (epochs_.size() < 2 || time < epochs_.front().time || time > epochs_.back().time) {
    return std::nullopt;
  }
  const auto after = std::upper_bound(epochs_.begin() + 1, epochs_.end() - 1, time,
                                      [](UtcTime t, const Epoch& e) { return t < e.time; });
  const auto i = static_cast<std::size_t>(after - epochs_.begin()) - 1;
  if (joined(i, i + 1)) return state_at(i, time);
  // A gap: only its very ends are known, each joined to what lies on its other side.
  if (time == epochs_[i].time && i > 0 && joined(i - 1, i)) return state_at(i - 1, time);
  if (time == epochs_[i + 1].time && i + 2 < epochs_.size() && joined(i + 1, i + 2)) {
    return state_at(i + 1, time);
  }
  return std::nullopt;
}

bool AntennaTrack::joined(std::size_t first, std::size_t last) const {
  for (std::size_t i = first; i < last; ++i) {
    if (epochs_[i + 1].time - epochs_[i].time > options_.longest_gap) return false;
  }
  return true;
}

AntennaTrack::Interpolation AntennaTrack::linear(std::size_t i, UtcTime time) const {
  const double span_s = seconds_between(epochs_[i].time, epochs_[i + 1].time);
  const double share = seconds_between(epochs_[i].time, time) / span_s;
  const Eigen::Vector3d step = enu_m_[i + 1] - enu_m_[i];
  const double sigma_m = chord_error_s2(span_s, share) * options_.linear_acceleration_sigma_m_s2;
  return {enu_m_[i] + share * step, step / span_s, Eigen::Vector3d::Constant(sigma_m)};
}

AntennaTrack::Interpolation AntennaTrack::interpolate(std::size_t i, UtcTime time) const {
  const Interpolation chord = linear(i, time);
  const bool has_four = i >= 1 && i + 2 < epochs_.size() && joined(i - 1, i + 2) &&
                        std::all_of(&epochs_[i - 1], &epochs_[i - 1] + 4, [&](const Epoch& e) {
                          return e.quality == epochs_[i].quality;
                        });
  if (!has_four) return chord;
  std::array<double, 4> times_s{};
  std::array<Eigen::Vector3d, 4> points;
  for (std::size_t k = 0; k < 4; ++k) {
    times_s[k] = seconds_between(epochs_[i].time, epochs_[i - 1 + k].time);
    points[k] = enu_m_[i - 1 + k];
  }
  const Cubic cubic = cubic_through(times_s, points, seconds_between(epochs_[i].time, time));
  const double span_s = times_s[2];
  const double unseen_m = chord_error_s2(span_s, seconds_between(epochs_[i].time, time) / span_s) *
                          options_.cubic_acceleration_sigma_m_s2;
  // What a still higher order would add is a fraction of what this one added to the chord.
  const Eigen::Vector3d added_m = 0.25 * (cubic.value - chord.position_m);
  const Eigen::Vector3d variance_m2 = added_m.cwiseAbs2().array() + unseen_m * unseen_m;
  return {cubic.value, cubic.slope, variance_m2.cwiseSqrt()};
}

AntennaState AntennaTrack::state_at(std::size_t i, UtcTime time) const {
  const Epoch& before = epochs_[i];
  const Epoch& after = epochs_[i + 1];
  const Interpolation path = interpolate(i, time);
  const double share =
      seconds_between(before.time, time) / seconds_between(before.time, after.time);
  const Eigen::Matrix3d missed = path.sigma_m.cwiseAbs2().asDiagonal();
  AntennaState state;
  state.position = frame_->geodetic_of(path.position_m);
  state.covariance_enu_m2 =
      (1 - share) * before.covariance_enu_m2 + share * after.covariance_enu_m2 + missed;
  state.velocity_enu_m_s = path.velocity_m_s;
  const bool before_counts = share < 1 && badness(before.quality) >= badness(after.quality);
  state.quality = before_counts || share <= 0 ? before.quality : after.quality;
  state.sigma_assumed = before.sigma_assumed || after.sigma_assumed;
  return state;
}

}  // namespace plumbline::gnss
