// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "tests/firmware/commands/acceptance/program.h"

namespace plumbline::acceptance {

// A folder for `plumbline orient`, made from truth by the collinearity equations as textbooks
// write them (K. Kraus, Photogrammetry, 2nd ed. 2007, eq. 5.3-4), apart from the program's own
// code. Distances in metres, angles in degrees.
struct CasePlan {
  unsigned seed = 1;
  bool stations = true;
  double side_step_m = 10;
  double heading_sigma_deg = 0;                           // 0: no heading
  Eigen::Vector3d lever_arm_m = Eigen::Vector3d::Zero();  // right, up, back
  double offset_sigma_m = 0;                              // common to all stations
  bool control = false;                                   // the first four targets, 5 mm
  bool length = false;                                    // between the first two targets, 5 mm
};

struct TruePhoto {
  Eigen::Vector3d centre_m;
  double omega_deg = 0, phi_deg = 0, kappa_deg = 0;
};

struct MadeCase {
  std::vector<TruePhoto> photos;
  std::vector<Eigen::Vector3d> points;  // P0, P1, ...
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
};

// Writes camera.toml, photos.csv, observations.csv, check.csv and what else the plan names.
MadeCase write_case(const CasePlan& plan, const fs::path& folder);

}  // namespace plumbline::acceptance
