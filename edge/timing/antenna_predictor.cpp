// SPDX-License-Identifier: MIT
#include "edge/timing/antenna_predictor.h"

#include <Eigen/Cholesky>
#include <utility>

#include "edge/gnss/antenna_track.h"
#include "edge/gnss/leap_seconds.h"

namespace plumbline::timing {
namespace {

geodesy::Geodetic place_of(const GnssFix& fix) {
  return {*fix.latitude_deg, *fix.longitude_deg, *fix.height_ellipsoidal_m};
}

Eigen::Matrix3d stated_enu_m2(const GnssFix& fix) {
  const Eigen::Matrix3d usual = gnss::usual_sigma_enu_m(fix.quality).cwiseAbs2().asDiagonal();
  return fix.covariance_enu_m2.value_or(usual);
}

double sigmas_off(const MotionState& foreseen, const Eigen::Vector3d& position_m,
                  const Eigen::Matrix3d& noise_m2) {
  const Eigen::Vector3d off = position_m - foreseen.position_m();
  const Eigen::Matrix3d spread = foreseen.covariance.topLeftCorner<3, 3>() + noise_m2;
  return std::sqrt(off.dot(spread.ldlt().solve(off)));
}

}  // namespace

// A fix, in the local frame.
struct AntennaPredictor::Seen {
  GpsTime time;
  Eigen::Vector3d position_m;
  Eigen::Matrix3d stated_m2;
  FixQuality quality;
  bool sigma_assumed;
};

AntennaPredictor::AntennaPredictor(const PredictorOptions& options)
    : options_(options), filter_(options.motion), epochs_(options.most_epochs) {}

bool AntennaPredictor::add(const GnssFix& fix) {
  if (!frame_ && gnss::is_position(fix)) {
    if (auto frame = geodesy::LocalFrame::at(place_of(fix))) frame_ = *frame;
  }
  const auto seen = seen_in(fix);
  if (!seen) {
    ++summary_.no_position;
    return false;
  }
  if (!epochs_.empty() && seen->time <= epochs_.back().time) {
    ++summary_.repeated;
    return false;
  }
  if (epochs_.empty()) {
    begin(*seen);
    return true;
  }
  return go_on(*seen);
}

std::optional<AntennaPredictor::Seen> AntennaPredictor::seen_in(const GnssFix& fix) const {
  if (!frame_ || !gnss::is_position(fix) || !fix.time) return std::nullopt;
  const auto time = gnss::gps_of(*fix.time);
  if (!time) return std::nullopt;
  const geodesy::Geodetic place = place_of(fix);
  const Eigen::Matrix3d turn = frame_->enu_from_enu_at(place);
  return Seen{*time, frame_->enu_of(place), turn * stated_enu_m2(fix) * turn.transpose(),
              fix.quality, !fix.covariance_enu_m2};
}

void AntennaPredictor::begin(const Seen& seen) {
  const MotionState state =
      filter_.begun_at(seen.position_m, options_.white_share * seen.stated_m2);
  keep({seen.time, state, state, seen.stated_m2, seen.quality, seen.sigma_assumed, true});
}

bool AntennaPredictor::go_on(const Seen& seen) {
  const Epoch& last = epochs_.back();
  const nanoseconds gap = seen.time - last.time;
  if (gap > options_.longest_gap) {
    ++summary_.restarts;
    begin(seen);
    return true;
  }
  MotionState foreseen = filter_.after(last.state, in_seconds(gap));
  Eigen::Matrix3d changed_m2 = Eigen::Matrix3d::Zero();
  if (seen.quality != last.quality) changed_m2 = last.stated_m2 + seen.stated_m2;
  foreseen.covariance.topLeftCorner<3, 3>() += changed_m2;
  const Eigen::Matrix3d noise_m2 = options_.white_share * seen.stated_m2;
  // The common error drifts, too: what is stated, not the white part, is the measure.
  if (sigmas_off(foreseen, seen.position_m, seen.stated_m2) > options_.gate_sigmas) {
    foreseen = filter_.after_a_turn(last.state, in_seconds(gap));
    foreseen.covariance.topLeftCorner<3, 3>() += changed_m2;
    if (sigmas_off(foreseen, seen.position_m, seen.stated_m2) > options_.turn_gate_sigmas) {
      return refuse(seen);
    }
  }
  const MotionState state = MotionFilter::with(foreseen, seen.position_m, noise_m2);
  keep({seen.time, foreseen, state, seen.stated_m2, seen.quality, seen.sigma_assumed, false});
  return true;
}

bool AntennaPredictor::refuse(const Seen& seen) {
  if (++outliers_in_a_row_ < options_.confirming) {
    ++summary_.outliers;
    return false;
  }
  ++summary_.restarts;
  begin(seen);
  return true;
}

void AntennaPredictor::keep(Epoch epoch) {
  ++summary_.used;
  outliers_in_a_row_ = 0;
  epochs_.push_back(std::move(epoch));
  while (epochs_.back().time - epochs_.front().time > options_.history) epochs_.pop_front();
}

// An epoch as known from those after it, too, as far as they are joined.
MotionState AntennaPredictor::known_at(std::size_t index) const {
  constexpr std::size_t kFarEnough = 20;
  std::size_t last = index;
  while (last + 1 < epochs_.size() && last - index < kFarEnough && !epochs_[last + 1].begins) {
    ++last;
  }
  MotionState known = epochs_[last].state;
  for (std::size_t k = last; k-- > index;) {
    known = filter_.smoothed(epochs_[k].state, in_seconds(epochs_[k + 1].time - epochs_[k].time),
                             epochs_[k + 1].foreseen, known);
  }
  return known;
}

std::optional<MotionState> AntennaPredictor::motion_at(std::size_t before, GpsTime time) const {
  const Epoch& epoch = epochs_[before];
  const MotionState ahead = filter_.after(epoch.state, in_seconds(time - epoch.time));
  if (before + 1 == epochs_.size()) return ahead;
  const Epoch& next = epochs_[before + 1];
  if (time == epoch.time) return known_at(before);
  if (next.begins) return std::nullopt;
  return filter_.smoothed(ahead, in_seconds(next.time - time), next.foreseen, known_at(before + 1));
}

std::optional<PredictedAntenna> AntennaPredictor::at(GpsTime time) const {
  if (epochs_.empty() || time < epochs_.front().time) return std::nullopt;
  if (time - epochs_.back().time > options_.longest_ahead) return std::nullopt;
  std::size_t before = epochs_.size() - 1;  // most often it is one of the last that is asked for
  while (epochs_[before].time > time) --before;
  const auto motion = motion_at(before, time);
  if (!motion) return std::nullopt;
  const Epoch& epoch = epochs_[before];
  PredictedAntenna antenna;
  antenna.time = time;
  antenna.ahead = time - epochs_.back().time;
  antenna.position = frame_->geodetic_of(motion->position_m());
  const Eigen::Matrix3d turn = frame_->enu_from_enu_at(antenna.position).transpose();
  const Eigen::Matrix3d covariance_m2 =
      motion->covariance.topLeftCorner<3, 3>() + (1 - options_.white_share) * epoch.stated_m2;
  antenna.covariance_enu_m2 = turn * covariance_m2 * turn.transpose();
  antenna.velocity_enu_m_s = turn * motion->velocity_m_s();
  antenna.quality = epoch.quality;
  antenna.sigma_assumed = epoch.sigma_assumed;
  return antenna;
}

std::optional<PredictedAntenna> AntennaPredictor::at(HostTime time, const GnssClock& clock) const {
  const auto instant = clock.gps_of(time);
  auto antenna = at(instant.time);
  if (!antenna) return std::nullopt;
  const Eigen::Vector3d moved_m = antenna->velocity_enu_m_s * in_seconds(instant.sigma_fit);
  antenna->covariance_enu_m2 += moved_m * moved_m.transpose();
  antenna->latency_shift_enu_m = antenna->velocity_enu_m_s * in_seconds(instant.sigma_latency);
  return antenna;
}

}  // namespace plumbline::timing
