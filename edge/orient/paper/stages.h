// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/geometry/camera.h"

namespace plumbline::orient::paper {

// The intermediate results of the published procedure (Kunii and Kumazaki 2018), stage by stage.
// Vectors "by photo" and "by point" are as Problem::photos and Problem::point_names.

// (1) Heights of the photos over the known length, eq. 1, and their differences to photo 1, the
// lowest, eq. 2.
struct Heights {
  int lowest = 0;                 // photo 1 of the paper
  std::vector<double> length_px;  // by photo: the known length in the image
  std::vector<double> height_m;   // H_i = L f / l_i
  std::vector<double> base_z_m;   // B_zi = H_i - H_1
};

// (2) Relative orientation of all pairs (1, i) at once, eq. 3 and 4, with B_z from stage 1. Frame:
// photo 1 at the origin without tilt.
struct RelativeOrientation {
  geometry::InteriorVector interior = geometry::InteriorVector::Zero();
  std::vector<geometry::Pose> poses;  // by photo
  int conditions = 0;                 // coplanarity conditions, one per point and pair
  int unknowns = 0;                   // 10 + 5 (n - 1) where no parameter is held fixed
  double rms_px = 0;                  // Sampson distance of image points from coplanarity
  int iterations = 0;
  bool converged = false;
};

// (3) Intersection of the rays, eq. 5, in the frame of stage 2.
struct Intersection {
  std::vector<Eigen::Vector3d> points;              // by point
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // of the ground: Z = p0 + p1 X + p2 Y
  double rms_px = 0;  // reprojection; large where the pairs' scales do not agree (eq. 1)
  int iterations = 0;
  bool converged = false;
};

// (4) Scale by the known length, and the local frame of the three points.
struct ScaledModel {
  double scale = 1;  // metres per unit of stage 2
  std::vector<geometry::Pose> poses;
  std::vector<Eigen::Vector3d> points;
};

// (5) Resection of all photos, and the camera, with the points held; (6) final adjustment of
// everything. Local frame, metres.
struct Adjusted {
  geometry::InteriorVector interior = geometry::InteriorVector::Zero();
  std::vector<geometry::Pose> poses;
  std::vector<Eigen::Vector3d> points;
  double rms_px = 0;  // reprojection
  int iterations = 0;
  bool converged = false;
};

}  // namespace plumbline::orient::paper
