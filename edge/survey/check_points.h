// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"

namespace plumbline::survey {

// A point whose position is known independently. Never used in the adjustment.
struct CheckPoint {
  std::string point;
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();
};

struct CheckedPoint {
  std::string point;
  Eigen::Vector3d difference_m = Eigen::Vector3d::Zero();  // measured minus known
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();       // of the difference
  // After a similarity of all check points; zero where there is none (CheckReport below).
  Eigen::Vector3d best_fit_difference_m = Eigen::Vector3d::Zero();
};

struct CheckReport {
  std::vector<CheckedPoint> points;
  std::vector<std::string> not_measured;  // known, but not among the measured points
  std::vector<std::string> also_control;  // left out: the adjustment has already used them
  // False where nothing ties the adjustment to the frame of the known points (no GNSS position, no
  // control): then only the best-fit figures mean something.
  bool same_frame = true;
  Eigen::Vector3d rmse_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rms_stated_sigma_m = Eigen::Vector3d::Zero();
  double largest_m = 0;               // largest |difference| of any axis of any point
  double share_within_one_sigma = 0;  // of all 3n differences
  double share_within_two_sigma = 0;
  // d' C^-1 d over all points together; dof 0 where the joint covariance is not known.
  double joint_nees = 0;
  int joint_nees_dof = 0;
  // 99 % interval of chi-square with that many degrees of freedom.
  double joint_nees_low = 0;
  double joint_nees_high = 0;
  // False where azimuth or level of the whole are known so poorly that a turn within their sigma
  // moves points off the straight line that error bars describe: then the joint test says nothing.
  bool joint_nees_holds = true;
  // After a 7-parameter similarity to the known points (three points or more).
  std::optional<Eigen::Vector3d> best_fit_rmse_m;
  // In a local frame of three points: what "everything is flat" (Z = 0) would have scored in
  // height, the least that heights worth the name must beat.
  std::optional<double> flat_rmse_u_m;
};

// Compares; a failure where no check point was measured. The covariance of the differences is that
// of the points (jointly, where the solution has it) plus the squared sigmas of the known points.
// Best fit: S. Umeyama 1991, eq. 40 to 43.
Result<CheckReport> check(const orient::Problem& problem, const orient::Solution& solution,
                          const std::vector<CheckPoint>& known);

}  // namespace plumbline::survey
