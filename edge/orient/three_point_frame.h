// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "edge/base/result.h"
#include "edge/orient/options.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"

namespace plumbline::orient {

// local = turn (place - origin): right-handed, metres.
struct ThreePointFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d x_axis = Eigen::Vector3d::Zero();  // local place of that point: (xa, 0, 0)
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();   // (xb, yb, 0)

  Eigen::Vector3d operator()(const Eigen::Vector3d& place) const { return turn * (place - origin); }
};

// The frame of three places, as in Kunii and Kumazaki 2018, section 4: `origin` at 0, `x_axis` on
// +X, `plane` in the X-Y plane, and Z to the side of `above`. Empty where the three lie within
// about a degree of one line.
std::optional<ThreePointFrame> three_point_frame(const Eigen::Vector3d& origin,
                                                 const Eigen::Vector3d& x_axis,
                                                 const Eigen::Vector3d& plane,
                                                 const Eigen::Vector3d& above);

// Restates a solution in the frame of three of its measured points, Z to the side of the photos.
// The e, n, u of points, photos and GNSS residuals are then X, Y, Z, and every covariance is that
// relative to the frame (S-transformation: Baarda 1973; Teunissen 1985), so that the origin has
// none, x_axis only a sigma of X, and plane none of Z. Image residuals, camera, scale and shape
// stay as adjusted; what the frame defines (azimuth, level, position) is no longer unobservable,
// but said so where the three points carry it badly; and `relief` is, where the heights cannot be
// told from a flat ground.
//
// Fails with a sentence where one of the three was not measured, or they are on one line.
Result<Solution> in_three_point_frame(const Problem& problem, const Solution& solution,
                                      const FrameRoles& roles, const Options& options);

}  // namespace plumbline::orient
