// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edge/geometry/camera.h"

namespace plumbline::orient {

// Everything known before the adjustment. All ground coordinates are local ENU, metres. A sigma is
// one standard deviation.

// Where the antenna (or, with a zero lever arm, the camera) was at the exposure.
struct Station {
  Eigen::Vector3d antenna_in_enu_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();  // white part, photo to photo
};

struct AttitudePrior {
  Eigen::Vector3d omega_phi_kappa_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rad = Eigen::Vector3d::Zero();  // infinity = not known
};

// Azimuth of the photo's +y axis from north, clockwise; at zero tilt heading = -kappa. The sigma
// is common to all photos (one compass).
struct HeadingPrior {
  double heading_rad = 0;
  double sigma_rad = 0;
};

struct Photo {
  std::string name;
  std::optional<Station> station;
  std::optional<AttitudePrior> attitude;
  std::optional<HeadingPrior> heading;
  std::optional<double> time_s;                        // for correlated GNSS errors
  std::optional<Eigen::Vector3d> velocity_in_enu_m_s;  // of the antenna
};

// Image observations are weighted by groups; the variance of a group whose sigma nobody stated is
// estimated from its residuals.
enum class ImageGroup { kTies, kPicks, kStated };

struct Observation {
  int photo = 0;
  int point = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 1.0;  // as stated, or (kTies, kPicks) relative within its group
  ImageGroup group = ImageGroup::kTies;
};

struct Length {
  int point_a = 0;
  int point_b = 0;
  double metres = 0;
  double sigma_m = 0.001;
};

// What makes a ground point known: somebody surveyed it, or it is declared, as a point that defines
// the local frame or one of flat ground.
enum class KnownBy { kSurvey, kFrameOrigin, kFrameXAxis, kFramePlane, kFlatGround };

// A ground point known before. A sigma of 0 is taken as 0.1 mm.
struct Control {
  int point = 0;
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();
  KnownBy known_by = KnownBy::kSurvey;
};

// GNSS error = offset common to the flight + Gauss-Markov of time constant `correlation_s` + white
// (the white part stands in each Station). Horizontal sigma holds for east and for north.
struct GnssErrorModel {
  double offset_sigma_horizontal_m = 0;
  double offset_sigma_vertical_m = 0;
  double correlation_s = 0;  // 0: no correlated part
  double correlated_sigma_horizontal_m = 0;
  double correlated_sigma_vertical_m = 0;
};

// Antenna minus camera: right, up, back in the photo frame.
struct LeverArm {
  Eigen::Vector3d in_photo_m = Eigen::Vector3d::Zero();
  double sigma_m = 0;  // of each component, common to the flight
};

// The exposure of a photo (of its middle row) happens this much later than the instant its station
// was taken for: it had moved on by velocity * seconds. A sigma of 0 holds it fixed.
struct Delay {
  double seconds = 0;
  double sigma_s = 0;
};

struct Problem {
  geometry::Camera camera;
  std::vector<Photo> photos;
  std::vector<std::string> point_names;  // also the number of points
  std::vector<Observation> observations;
  std::vector<Length> lengths;
  std::vector<Control> control;
  GnssErrorModel gnss;
  LeverArm lever_arm;
  Delay delay;
};

}  // namespace plumbline::orient
