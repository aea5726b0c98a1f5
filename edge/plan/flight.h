// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"

namespace plumbline::plan {

// A vertical climb as it is planned. Heights are above the ground at its foot, metres.
struct Climb {
  double from_m = 70;
  double to_m = 90;
  double step_m = 5;
  // After the top photo, at its height: each leg is turned 90 degrees from the one before, the
  // first goes east. Two legs make an L.
  std::vector<double> side_steps_m;
};

// paper: 70 to 90 m every 5 m; standard: 30 to 90 m every 5 m, then 10 m aside; ice: 10 to 60 m
// every 2.5 m, then 5 m aside. Empty for any other name.
std::optional<Climb> named_climb(const std::string& name);

// What the receiver told of the place of one photo.
struct PhotoFix {
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();  // white: of this photo alone
  // Of the antenna: an exposure that is late by Options::delay_sigma_s is off by it.
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
};

// Where the camera is at each photo: east and north about any origin, height above the ground,
// metres. A flight in the air has photos that were taken and photos to come; a planned one has
// only the latter. Taken ones are where they were taken; those ahead may wander about their place.
struct Flight {
  std::vector<Eigen::Vector3d> taken_m;
  std::vector<PhotoFix> taken_fixes;  // one for each that was taken; none: as Options::rtk has it
  std::vector<Eigen::Vector3d> ahead_m;
  std::optional<Eigen::Vector2d> foot_m;  // of the climb; default: the median of the places

  std::size_t photos() const { return taken_m.size() + ahead_m.size(); }
  std::vector<Eigen::Vector3d> all_m() const;
};

// In one sentence, what makes it impossible to fly; Done where nothing does.
Status check(const Climb& climb);

// The climb must pass check().
Flight flight_of(const Climb& climb);

// The point on the ground below the line of the climb.
Eigen::Vector2d foot_of(const Flight& flight);

// The highest and the lowest photo, and the usual height between two that follow each other along
// the climb (5 m where there are fewer than two heights).
double highest_m(const Flight& flight);
double lowest_m(const Flight& flight);
double usual_step_m(const Flight& flight);

}  // namespace plumbline::plan
