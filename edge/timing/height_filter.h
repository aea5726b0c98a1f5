// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

namespace plumbline::timing {

// How the height may go on: its acceleration is noise with this sigma and correlation.
struct HeightModel {
  double acceleration_m_s2 = 0;
  double correlation_s = 1;
  double white_share = 1;  // of the stated variance: what is new with each epoch
  double lasts_s = 10;     // before another model holds
};

struct ForeseenHeight {
  double height_m = 0;
  double climb_m_s = 0;
  double variance_m2 = 0;  // of the height, without the error that epochs share
};

// The height of the antenna some tenths of a second ahead. A steady climb in gusts and a pilot at
// the stick are different motions, and what a receiver states as sigma may be new with every epoch
// or nearly all shared: four models run side by side, and those count that foresee the epochs best
// (the interacting multiple models of Blom and Bar-Shalom, 1988). Pure; no allocation.
class HeightFilter {
 public:
  // A new start at this height.
  void begin(double height_m, double stated_m2);

  // `seconds` after the epoch before.
  void add(double seconds, double height_m, double stated_m2);

  // The position as it was said has jumped by an unknown error of this variance: the quality of the
  // fix has changed. Call before add().
  void unsettle(double variance_m2);

  // `seconds` >= 0 after the last epoch; empty before the first.
  std::optional<ForeseenHeight> after(double seconds) const;

 private:
  static constexpr std::size_t kModels = 4;
  struct Track {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();  // height, climb rate, acceleration
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double probability = 1.0 / kModels;
  };

  void mix(double seconds);

  std::array<Track, kModels> tracks_;
  bool begun_ = false;
};

}  // namespace plumbline::timing
