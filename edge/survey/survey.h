// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "edge/image/tie_points.h"
#include "edge/orient/adjust.h"

namespace plumbline::survey {

// FRONT DOOR: photos and fixes in, points with error bars out.

// A point measured by hand in a photo. Where the sigma is not stated, it is estimated.
struct NamedPick {
  int photo = 0;
  std::string point;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::optional<double> sigma_px;
};

struct NamedLength {
  std::string point_a;
  std::string point_b;
  double metres = 0;
  double sigma_m = 0.001;
};

struct NamedControl {
  std::string point;
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();
};

struct Input {
  geometry::Camera camera;            // the starting camera, with its prior sigmas
  std::vector<orient::Photo> photos;  // with what is known of each
  GreyImageSource images;             // photo i of `photos`, all of the camera's size
  // Found before: then `images` is not asked for, and a point picked in one photo stays there.
  std::optional<image::TiePoints> ties;
  std::vector<NamedPick> picks;
  std::vector<NamedLength> lengths;
  std::vector<NamedControl> control;
  orient::GnssErrorModel gnss;
  orient::LeverArm lever_arm;
  orient::Delay delay;
};

struct Options {
  image::TieOptions ties;
  orient::Options adjustment;
};

struct Counts {
  int photos_given = 0;
  int photos_used = 0;
  int tie_points = 0;        // measured, in two photos or more
  int tie_points_3plus = 0;  // measured, in three photos or more
};

struct Survey {
  orient::Problem problem;  // as adjusted: picks first, then ties named T1, T2, ...
  orient::Solution solution;
  Counts counts;
};

// Finds tie points, follows the picks, and orients all photos in one adjustment. `finder` keeps
// what it has found for a call with more photos of the same flight.
Result<Survey> measure(const Input& input, const Options& options, const Progress& progress,
                       image::TieFinder& finder);
Result<Survey> measure(const Input& input, const Options& options, const Progress& progress);

Counts count(const orient::Problem& problem, const orient::Solution& solution);

}  // namespace plumbline::survey
