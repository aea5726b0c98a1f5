// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace plumbline::service {

// What a person in the field wants to know of a result.
struct ResultFigures {
  int photos = 0;                   // oriented
  Eigen::Vector3d sigma_enu_m;      // medians over the points
  bool azimuth_is_unknown = false;  // said to be not observable
  int photos_given = 0;
  bool converged = true;
};

// From RESULT/summary.json. Empty where it is missing or not one of a result.
std::optional<ResultFigures> read_result(const std::string& folder);

// "Median sigma 1.6/1.8/1.3 cm east/north/up."
std::string in_words(const ResultFigures& figures);

// The same in 50 characters at most, for the pilot: "Result 15 photos: 1.6/1.8/1.3 cm".
std::string for_the_pilot(const ResultFigures& figures);

}  // namespace plumbline::service
