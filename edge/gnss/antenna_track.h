// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <vector>

#include "edge/base/gnss_fix.h"
#include "edge/geodesy/local_frame.h"

namespace plumbline::gnss {

struct TrackOptions {
  std::chrono::microseconds longest_gap = std::chrono::seconds(2);
  // Acceleration that interpolation may have missed, 1 sigma: between two epochs only, and with
  // two more around them. A multicopter seldom exceeds 1 m/s2; a cubic follows nine tenths of it.
  double linear_acceleration_sigma_m_s2 = 1.0;
  double cubic_acceleration_sigma_m_s2 = 0.1;
};

// The antenna at one instant.
struct AntennaState {
  geodesy::Geodetic position;
  // East, north, up at the position: of the two epochs around it, plus what interpolation may have
  // missed. Errors of neighbouring epochs are nearly the same error, so it does not shrink by
  // averaging.
  Eigen::Matrix3d covariance_enu_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d velocity_enu_m_s = Eigen::Vector3d::Zero();
  FixQuality quality = FixQuality::kNone;  // the worse of the two epochs around it
  bool sigma_assumed = false;              // the receiver stated none
};

// A standard deviation per axis (east, north, up) for a fix that states none: what is usual for
// its quality (fixed 1 and 2 cm, float 0.3 and 0.6 m, differential 0.6 and 1.2 m, single 3 and
// 6 m, horizontal and vertical).
Eigen::Vector3d usual_sigma_enu_m(FixQuality quality);

// A fix that can be worked with: measured from satellites, with height.
bool is_position(const GnssFix& fix);

// A path through the positions of a log.
class AntennaTrack {
 public:
  struct Epoch {
    UtcTime time;
    geodesy::Geodetic position;
    Eigen::Matrix3d covariance_enu_m2;
    FixQuality quality;
    bool sigma_assumed;
  };

  // Takes those of `fixes` that are positions with a date; in order of time, the first of equals.
  static AntennaTrack from(const std::vector<GnssFix>& fixes, const TrackOptions& options = {});

  bool empty() const { return epochs_.empty(); }
  const std::vector<Epoch>& epochs() const { return epochs_; }

  // Cubic (Lagrange) through four epochs where all have one quality and no gap lies between,
  // otherwise linear. Empty outside the log and within gaps longer than longest_gap.
  std::optional<AntennaState> at(UtcTime time) const;

 private:
  struct Interpolation {
    Eigen::Vector3d position_m;
    Eigen::Vector3d velocity_m_s;
    Eigen::Vector3d sigma_m;
  };

  bool joined(std::size_t first, std::size_t last) const;
  Interpolation linear(std::size_t i, UtcTime time) const;
  Interpolation interpolate(std::size_t i, UtcTime time) const;
  AntennaState state_at(std::size_t i, UtcTime time) const;

  TrackOptions options_;
  std::vector<Epoch> epochs_;
  std::vector<Eigen::Vector3d> enu_m_;  // of epochs_, about the first
  std::optional<geodesy::LocalFrame> frame_;
};

}  // namespace plumbline::gnss
