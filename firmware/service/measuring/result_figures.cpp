// SPDX-License-Identifier: MIT
#include "firmware/service/measuring/result_figures.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

namespace plumbline::service {
namespace {

std::string sigmas(const Eigen::Vector3d& sigma_m) {
  const bool small = sigma_m.maxCoeff() < 1;
  const Eigen::Vector3d shown = (small ? 100.0 : 1.0) * sigma_m;
  char text[48];
  std::snprintf(text, sizeof text, "%.1f/%.1f/%.1f %s", shown.x(), shown.y(), shown.z(),
                small ? "cm" : "m");
  return text;
}

}  // namespace

std::optional<ResultFigures> read_result(const std::string& folder) {
  std::ifstream file(folder + "/summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  try {
    const auto& points = summary.at("point_sigmas");
    const auto& unobservable = summary.at("unobservable");
    ResultFigures figures;
    figures.photos = summary.at("photos_used");
    const auto median_m = [&](const char* axis) { return points.at(axis).get<double>(); };
    figures.sigma_enu_m = {median_m("median_e_m"), median_m("median_n_m"), median_m("median_u_m")};
    figures.azimuth_is_unknown =
        std::find(unobservable.begin(), unobservable.end(), "azimuth") != unobservable.end();
    figures.photos_given = summary.value("photos_given", figures.photos);
    figures.converged = summary.value("converged", true);
    return figures;
  } catch (const nlohmann::json::exception&) {  // another shape, or a figure that is null
    return std::nullopt;
  }
}

std::string in_words(const ResultFigures& figures) {
  return "Median sigma " + sigmas(figures.sigma_enu_m) + " east/north/up" +
         (figures.azimuth_is_unknown ? ", azimuth unknown." : ".");
}

std::string for_the_pilot(const ResultFigures& figures) {
  return "Result " + std::to_string(figures.photos) + " photos: " + sigmas(figures.sigma_enu_m) +
         (figures.azimuth_is_unknown ? ", no azimuth" : "");
}

}  // namespace plumbline::service
