// SPDX-License-Identifier: MIT
#include "edge/timing/height_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumbline::timing {
namespace {

// A steady climb in gusts of 0.1 to 0.2 m/s (which change within a second: white acceleration of
// 0.02 m2/s3, kept short) and a pilot at the stick; each with a receiver whose stated sigma is
// mostly shared by its epochs, and one where it is all new.
constexpr std::array<HeightModel, 4> kHow = {
    {{0.3, 0.1, 0.2, 10}, {2.0, 0.7, 0.2, 1.5}, {0.3, 0.1, 1.0, 10}, {2.0, 0.7, 1.0, 1.5}}};
constexpr double kNoiseLasts_s = 120;
constexpr double kLeastProbability = 1e-4;
constexpr double kFirstClimb_m_s = 3;

// From one model to another within `seconds`.
double chance(std::size_t from, std::size_t to, double seconds) {
  const double stays = std::exp(-seconds / kHow[from].lasts_s);
  const double noise_stays = std::exp(-seconds / kNoiseLasts_s);
  const bool same_motion = from % 2 == to % 2;
  const bool same_noise = from / 2 == to / 2;
  return (same_motion ? stays : 1 - stays) * (same_noise ? noise_stays : 1 - noise_stays);
}

// Acceleration as a first-order Markov process (Singer 1970): what it adds to climb and height.
Eigen::Matrix3d transition(const HeightModel& model, double seconds) {
  const double tau = model.correlation_s;
  const double decay = std::exp(-seconds / tau);
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 1) = seconds;
  matrix(0, 2) = tau * (seconds - tau * (1 - decay));
  matrix(1, 2) = tau * (1 - decay);
  matrix(2, 2) = decay;
  return matrix;
}

// The noise of that process over `seconds`, by Simpson's rule over the instants at which it enters.
Eigen::Matrix3d process_noise(const HeightModel& model, double seconds) {
  const double density =
      2 * model.acceleration_m_s2 * model.acceleration_m_s2 / model.correlation_s;
  constexpr int kPieces = 8;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  for (int k = 0; k <= kPieces; ++k) {
    const double weight = k == 0 || k == kPieces ? 1 : (k % 2 == 1 ? 4 : 2);
    const Eigen::Vector3d response = transition(model, seconds * k / kPieces).col(2);
    noise += weight * response * response.transpose();
  }
  return density * seconds / (3 * kPieces) * noise;
}

}  // namespace

void HeightFilter::begin(double height_m, double stated_m2) {
  for (std::size_t k = 0; k < kModels; ++k) {
    tracks_[k].mean = {height_m, 0, 0};
    tracks_[k].covariance =
        Eigen::Vector3d(kHow[k].white_share * stated_m2, kFirstClimb_m_s * kFirstClimb_m_s,
                        std::pow(kHow[k].acceleration_m_s2, 2))
            .asDiagonal();
    if (!begun_) tracks_[k].probability = 1.0 / kModels;
  }
  begun_ = true;
}

void HeightFilter::unsettle(double variance_m2) {
  for (Track& track : tracks_) track.covariance(0, 0) += variance_m2;
}

// Each model starts the step from what all of them know, by how probably one became the other.
void HeightFilter::mix(double seconds) {
  const std::array<Track, kModels> before = tracks_;
  for (std::size_t to = 0; to < kModels; ++to) {
    Track& track = tracks_[to];
    track = {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0};
    for (std::size_t from = 0; from < kModels; ++from) {
      const double share = before[from].probability * chance(from, to, seconds);
      track.probability += share;
      track.mean += share * before[from].mean;
    }
    track.mean /= track.probability;
    for (std::size_t from = 0; from < kModels; ++from) {
      const double share = before[from].probability * chance(from, to, seconds);
      const Eigen::Vector3d apart = before[from].mean - track.mean;
      track.covariance +=
          share / track.probability * (before[from].covariance + apart * apart.transpose());
    }
  }
}

void HeightFilter::add(double seconds, double height_m, double stated_m2) {
  mix(seconds);
  double total = 0;
  for (std::size_t k = 0; k < kModels; ++k) {
    Track& track = tracks_[k];
    const Eigen::Matrix3d forward = transition(kHow[k], seconds);
    track.mean = forward * track.mean;
    track.covariance =
        forward * track.covariance * forward.transpose() + process_noise(kHow[k], seconds);
    const double spread_m2 = track.covariance(0, 0) + kHow[k].white_share * stated_m2;
    const double off_m = height_m - track.mean[0];
    const Eigen::Vector3d gain = track.covariance.col(0) / spread_m2;
    track.mean += gain * off_m;
    track.covariance -= gain * spread_m2 * gain.transpose();
    track.probability *= std::exp(-0.5 * std::min(off_m * off_m / spread_m2, 200.0)) /
                         std::sqrt(2 * std::numbers::pi * spread_m2);
    total += track.probability;
  }
  for (Track& track : tracks_) {
    track.probability = std::max(track.probability / total, kLeastProbability);
  }
}

std::optional<ForeseenHeight> HeightFilter::after(double seconds) const {
  if (!begun_) return std::nullopt;
  ForeseenHeight foreseen;
  double total = 0, squares_m2 = 0;
  for (std::size_t k = 0; k < kModels; ++k) {
    const Track& track = tracks_[k];
    const Eigen::Matrix3d forward = transition(kHow[k], seconds);
    const Eigen::Vector3d mean = forward * track.mean;
    const double variance_m2 =
        (forward * track.covariance * forward.transpose() + process_noise(kHow[k], seconds))(0, 0);
    total += track.probability;
    foreseen.height_m += track.probability * mean[0];
    foreseen.climb_m_s += track.probability * mean[1];
    squares_m2 += track.probability * (variance_m2 + mean[0] * mean[0]);
  }
  foreseen.height_m /= total;
  foreseen.climb_m_s /= total;
  foreseen.variance_m2 = squares_m2 / total - foreseen.height_m * foreseen.height_m;
  return foreseen;
}

}  // namespace plumbline::timing
