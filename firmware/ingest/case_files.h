// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "firmware/ingest/case_folder.h"
#include "firmware/ingest/csv_table.h"
#include "firmware/ingest/photo_names.h"

namespace plumbline::ingest {

// The readers of a case's files, one each; read_case() calls them in order.
Result<std::vector<orient::Photo>> case_photos(const CsvTable& table,
                                               std::vector<std::string>& notices);

using PointNumbers = std::map<std::string, int, std::less<>>;

// Adds the observations and the points that they name to `problem`, which has its photos.
Result<PointNumbers> case_observations(const CsvTable& table, orient::Problem& problem,
                                       std::vector<std::string>& notices);

Result<orient::FrameRoles> case_frame_roles(const CsvTable& table, const PointNumbers& points,
                                            std::vector<std::string>& notices);
Result<orient::LeverArm> case_lever_arm(const CsvTable& table, std::vector<std::string>& notices);

// gnss.toml: offset_sigma_m = [h, v], correlation_s, correlated_sigma_m = [h, v]; delay_s and
// delay_sigma_s, by which the exposures came after the time of their positions (negative: before).
struct CaseGnss {
  orient::GnssErrorModel errors;
  orient::Delay delay;
};
Result<CaseGnss> case_gnss(const std::string& text, const std::string& name,
                           std::vector<std::string>& notices);

}  // namespace plumbline::ingest
