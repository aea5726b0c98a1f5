// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "edge/orient/adjust.h"

namespace plumbline::orient::testing {

// The flight of papers and README: a climb over a field of targets, seen by the paper's camera.
struct FlightPlan {
  std::vector<double> heights_m = {70, 75, 80, 85, 90};
  double side_step_m = 10;  // one more photo at the top, so far east; 0 = none
  double l_step_m = 0;      // and another, so far north of that one; 0 = none
  int targets = 39;
  int ties = 0;  // more points, over the ground of the highest photo, each seen in three photos
  double image_sigma_px = 0.3;
  double rtk_sigma_horizontal_m = 0.005;
  double rtk_sigma_vertical_m = 0.010;
  double tilt_sigma_deg = 1.0;
  double drift_m = 0.7;  // bowed, over the climb
  double relief_m = 1.5;
  double gross_share = 0;  // of observations, 5 to 300 px off
  bool stations = true;
  bool known_length = false;     // between the two targets nearest to 15 m apart, 1 mm
  double heading_sigma_deg = 0;  // 0: no heading given; a fifth of it is each photo's own
  double f_sigma = 0.5 / 2125;   // relative, of the calibration of the focal length
  bool free_camera = false;      // and all ten interior parameters as weakly known as it
  GnssErrorModel gnss;           // offset and correlated part, drawn as modelled
  double photo_interval_s = 2.5;
  // The climb's speeds by turns, first while it climbs; empty: none is given, nothing moves.
  std::vector<double> speeds_m_s;
  double delay_s = 0;      // of the exposures behind the stations
  double line_time_s = 0;  // of the rolling shutter, per row
  ImageGroup group = ImageGroup::kStated;
};

struct MadeFlight {
  Problem problem;
  std::vector<geometry::Pose> poses;
  std::vector<Eigen::Vector3d> points;  // targets, then ties
  geometry::InteriorVector interior;
  std::vector<bool> gross;  // by observation
  int targets = 0;
};

// Truth plus noise, the camera as calibrated among it (f 0.5 px, principal point 0.5 px,
// distortion 2e-4).
MadeFlight make_flight(const FlightPlan& plan, std::uint64_t seed);

bool calls_unobservable(const Summary& summary, const std::string& quantity);

}  // namespace plumbline::orient::testing
