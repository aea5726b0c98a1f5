// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "edge/geodesy/local_frame.h"
#include "edge/survey/check_points.h"
#include "edge/survey/survey.h"
#include "firmware/commands/derived_figures.h"

namespace plumbline::commands {

// What `plumbline measure` was asked to do.
struct MeasureArguments {
  std::vector<std::filesystem::path> photos;
  std::filesystem::path out;
  std::filesystem::path camera, picks, control, check, gnss, geoid;
  std::filesystem::path ties_from;  // an earlier result
  std::vector<std::string> lengths;
  std::string time_offset;
  std::string lever_arm;
  std::string lever_frame = "photo";
  std::string photo_heights;
  std::string datum = "that of the base";
  int threads = 0;  // 0: as many as the machine has
  bool json = false;
  bool follow = false;
  DerivedArguments derived;
  survey::Options options;
};

// All input files, read.
struct MeasureInputs {
  survey::Input survey;
  std::vector<survey::CheckPoint> check;
  std::optional<geodesy::LocalFrame> frame;
  int photos_given = 0;
  std::vector<std::string> warnings;
  std::map<std::string, std::string> sha256;
};

Result<MeasureInputs> read_measure_inputs(const MeasureArguments& arguments,
                                          const Progress& progress);

}  // namespace plumbline::commands
