// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/geodesy/geoid.h"
#include "edge/geodesy/local_frame.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"
#include "edge/survey/check_points.h"

namespace plumbline::ingest {

// The folder that `plumbline orient` is given: measured image coordinates and all that is known.
struct CaseFolder {
  orient::Problem problem;
  std::vector<survey::CheckPoint> check;          // never part of the problem
  std::optional<orient::FrameRoles> frame_roles;  // frame.csv: the paper's local frame
  // Where e/n/u lie on the earth: known only where control or check points are given on the earth
  // and the photos without e/n/u.
  std::optional<geodesy::LocalFrame> frame;
  std::vector<std::string> warnings;                // sentences
  std::map<std::string, std::string> input_sha256;  // file name to hash of each file read
};

// Reads camera.toml, photos.csv and observations.csv (required) and lengths.csv, control.csv,
// check.csv, frame.csv, lever_arm.csv and gnss.toml (where present). Points are numbered in the
// order in which observations.csv names them. An observation with a stated sigma_px is in the group
// kStated, the others in kPicks with sigma 1. Control that no photo observes is left out with a
// warning. Nothing in the folder can make it crash; what is wrong is one sentence with file and
// line.
//
// lever_arm.csv has one row and may hold sigma_m beside right_m,up_m,back_m. gnss.toml:
//   offset_sigma_m = [3.0, 5.0]      # horizontal, vertical: common to the flight
//   correlation_s = 30.0             # time constant of the slow part; needs time_s in photos.csv
//   correlated_sigma_m = [1.0, 2.0]  # horizontal, vertical: its standard deviation
//   delay_s = 0.02                   # the photos were taken so much later than their positions
//   delay_sigma_s = 0.05             # hold for; needs ve_m_s,vn_m_s,vu_m_s in photos.csv
// Position, attitude and time of a photo are those of its middle row (line_time_us, camera.toml).
Result<CaseFolder> read_case(const std::filesystem::path& folder, const geodesy::Geoid* geoid);

}  // namespace plumbline::ingest
