// SPDX-License-Identifier: MIT
#include "edge/orient/paper/scaled_model.h"

#include "edge/base/index.h"
#include "edge/orient/three_point_frame.h"

namespace plumbline::orient::paper {

Result<ScaledModel> scaled_model(const Problem& problem, const RelativeOrientation& relative,
                                 const Intersection& intersection, const Length& length,
                                 const FrameRoles& roles) {
  const auto place = [&](int point) { return intersection.points[at(point)]; };
  Eigen::Vector3d above = Eigen::Vector3d::Zero();
  for (const geometry::Pose& pose : relative.poses) above += pose.centre_m;
  above /= static_cast<double>(relative.poses.size());
  const auto frame =
      three_point_frame(place(roles.origin), place(roles.x_axis), place(roles.plane), above);
  const double in_model = (place(length.point_b) - place(length.point_a)).norm();
  if (!frame || !(in_model > 0)) {
    return Error{"The three points of frame.csv (" + problem.point_names[at(roles.origin)] + ", " +
                 problem.point_names[at(roles.x_axis)] + ", " +
                 problem.point_names[at(roles.plane)] +
                 ") lie on (nearly) one line, which makes no plane; choose a third point aside of "
                 "the line of the first two."};
  }
  ScaledModel out;
  out.scale = length.metres / in_model;
  for (const Eigen::Vector3d& point : intersection.points)
    out.points.emplace_back(out.scale * (*frame)(point));
  for (const geometry::Pose& pose : relative.poses) {
    out.poses.push_back(
        {out.scale * (*frame)(pose.centre_m), frame->turn * pose.ground_from_photo});
  }
  return out;
}

}  // namespace plumbline::orient::paper
