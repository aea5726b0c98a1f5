// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edge/orient/adjust.h"
#include "edge/orient/derived.h"
#include "edge/orient/paper/procedure.h"
#include "edge/orient/problem.h"
#include "edge/orient/solution.h"
#include "edge/survey/check_points.h"
#include "edge/survey/survey.h"

namespace plumbline::deliver {

// Where the local frame lies on the earth.
struct GeoOrigin {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_ellipsoidal_m = 0;
};

// A distance, an area or a volume that was asked for.
struct DerivedFigure {
  std::string kind;  // distance, area, volume
  std::vector<std::string> points;
  std::optional<double> level_m;         // of a volume
  std::optional<orient::Derived> value;  // empty: nothing gives the scale
  std::string unit;                      // m, m2, m3
};

// All that is delivered, whichever command made it.
struct Product {
  std::string title;  // what was measured, for the report: a folder's name
  orient::Problem problem;
  orient::Solution solution;
  orient::Options options;  // as adjusted with: the thresholds are printed
  survey::Counts counts;
  std::optional<survey::CheckReport> check;
  std::vector<DerivedFigure> derived;
  std::optional<orient::paper::Procedure> paper;  // the published procedure, where that was asked
  std::optional<GeoOrigin> origin;                // empty: local frame only
  std::string datum = "that of the base";
  int plane_rectangular_zone = 0;     // 1..19; 0: chosen by the origin, or UTM outside Japan
  std::vector<std::string> warnings;  // sentences, beside those of the solution
  std::map<std::string, std::string> input_sha256;  // file name (no folder) to hash
};

// Stage name and wall seconds, in order; peak memory in bytes. Only these go into timing.json.
struct Timing {
  std::vector<std::pair<std::string, double>> stages_s;
  std::size_t peak_memory_bytes = 0;
};

}  // namespace plumbline::deliver
