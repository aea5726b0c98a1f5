// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "edge/base/units.h"
#include "firmware/deliver/georeference.h"
#include "firmware/deliver/paper_stages.h"
#include "firmware/deliver/reliance.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/table.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

using Json = nlohmann::ordered_json;

Json from_text(const std::string& text) {
  double value = 0;
  if (text.empty()) return nullptr;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Json number(double value) {
  char buffer[64];
  if (!std::isfinite(value)) return nullptr;
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, 7);
  return from_text(std::string(buffer, end.ptr));
}

Json texts(const std::vector<std::string>& sentences) {
  Json list = Json::array();
  for (const std::string& sentence : sentences) list.push_back(clean_utf8(sentence));
  return list;
}

void add_axes(Json& to, const std::string& stem, const Eigen::Vector3d& value) {
  to[stem + "_e_m"] = number(value.x());
  to[stem + "_n_m"] = number(value.y());
  to[stem + "_u_m"] = number(value.z());
}

void add_adjustment(Json& json, const Product& product) {
  const orient::Summary& summary = product.solution.summary;
  json["converged"] = summary.converged;
  json["iterations"] = summary.iterations;
  json["sigma0"] = number(summary.sigma0);
  json["sigma0_by_group"] = Json::object();
  for (const auto& [group, sigma0] : summary.sigma0_by_group)
    json["sigma0_by_group"][clean_utf8(group)] = number(sigma0);
  json["image_sigma_px"] = number(summary.image_sigma_px);
  json["redundancy"] = summary.redundancy;
  json["photos_given"] = product.counts.photos_given;
  json["photos_used"] = product.counts.photos_used;
  json["tie_points"] = product.counts.tie_points;
  json["tie_points_3plus"] = product.counts.tie_points_3plus;
  json["reprojection_rms_px"] = number(summary.reprojection_rms_px);
  json["observations_rejected"] = summary.observations_rejected;
}

// What was found to be wrong and was not used, and what one single thing carries.
void add_blunders(Json& json, const orient::Summary& summary) {
  json["blunders"] = Json::array();
  for (const orient::Blunder& blunder : summary.blunders)
    json["blunders"].push_back({{"kind", clean_utf8(blunder.kind)},
                                {"subject", clean_utf8(blunder.subject)},
                                {"size", number(blunder.size)},
                                {"statistic", number(blunder.statistic)},
                                {"critical", number(blunder.critical)},
                                {"sentence", clean_utf8(blunder.sentence)}});
  json["unchecked"] = Json::array();
  for (const orient::Unchecked& item : summary.unchecked)
    json["unchecked"].push_back({{"quantity", item.quantity},
                                 {"rests_on", clean_utf8(item.subject)},
                                 {"sentence", clean_utf8(item.sentence)}});
}

// What the data do not tell apart, and the combinations known worst.
void add_correlations(Json& json, const orient::Summary& summary) {
  json["correlations"] = Json::array();
  for (const orient::Correlation& pair : summary.correlations)
    json["correlations"].push_back(
        {{"a", pair.a}, {"b", pair.b}, {"correlation", number(pair.value)}});
  json["weakest"] = Json::array();
  for (const orient::WeakCombination& combination : summary.weakest) {
    Json goes_with = Json::object();
    for (const auto& [name, correlation] : combination.goes_with)
      goes_with[name] = number(correlation);
    json["weakest"].push_back(
        {{"sigma_deg", number(combination.sigma_rad * kDegPerRad)}, {"goes_with", goes_with}});
  }
}

void add_observability(Json& json, const Product& product) {
  json["unobservable"] = Json::array();
  json["unobservable_explained"] = Json::object();
  for (const orient::Unobservable& item : product.solution.summary.unobservable) {
    json["unobservable"].push_back(clean_utf8(item.name));
    json["unobservable_explained"][clean_utf8(item.name)] = clean_utf8(item.sentence);
  }
  add_correlations(json, product.solution.summary);
  add_blunders(json, product.solution.summary);
  json["relative_only"] = texts(relative_only(product));
  std::vector<std::string> warnings = product.solution.summary.warnings;
  warnings.insert(warnings.end(), product.warnings.begin(), product.warnings.end());
  json["warnings"] = texts(warnings);
}

void add_common_sigmas(Json& json, const Product& product) {
  const orient::CommonSigmas& common = product.solution.summary.common;
  json["flying_height_m"] = number(product.solution.summary.flying_height_m);
  json["common_sigmas"] = {{"azimuth_deg", number(common.azimuth_rad * kDegPerRad)},
                           {"tilt_deg", number(common.tilt_rad * kDegPerRad)},
                           {"scale", number(common.scale)},
                           {"position_m", number(common.position_m)},
                           {"focal_length", number(common.focal_length)},
                           {"height", number(common.height)}};
  const orient::Summary& summary = product.solution.summary;
  json["delay_s"] = summary.delay ? number(summary.delay->seconds) : Json(nullptr);
  json["sigma_delay_s"] = summary.delay ? number(summary.delay->sigma_s) : Json(nullptr);
  const geometry::Camera& camera = product.solution.camera;
  json["line_time_us"] = number(camera.line_time_us);
  json["sigma_line_time_us"] = number(camera.line_time_sigma_us);
  json["focal_length_px"] = number(camera.interior[geometry::kFocalLength]);
  json["sigma_focal_length_px"] =
      camera.covariance
          ? number(std::sqrt((*camera.covariance)(geometry::kFocalLength, geometry::kFocalLength)))
          : Json(nullptr);
}

void add_point_figures(Json& json, const Product& product) {
  const PointKinds kinds = point_kinds(product);
  json["named_points"] = kinds.named.size();
  json["points_not_measured"] = texts(kinds.not_measured);
  const auto& points = kinds.named.empty() ? kinds.ties : kinds.named;
  if (const auto figures = sigma_figures(product, points)) {
    json["point_sigmas"]["of"] = kinds.named.empty() ? "tie points" : "named points";
    add_axes(json["point_sigmas"], "median", figures->median);
    add_axes(json["point_sigmas"], "largest", figures->largest);
    if (const auto local = local_sigma_figures(product, points))
      add_axes(json["point_sigmas"], "median_local", local->median);
  }
}

void add_thresholds(Json& json, const orient::Options& options) {
  json["options"] = {{"max_azimuth_sigma_deg", number(options.max_azimuth_sigma_deg)},
                     {"max_tilt_sigma_deg", number(options.max_tilt_sigma_deg)},
                     {"max_focal_length_sigma", number(options.max_focal_length_sigma)},
                     {"max_scale_sigma", number(options.max_scale_sigma)},
                     {"max_height_sigma", number(options.max_height_sigma)},
                     {"max_position_sigma_m", number(options.max_position_sigma_m)},
                     {"min_variance_reduction", number(options.min_variance_reduction)},
                     {"min_correlation", number(options.min_correlation)},
                     {"tilt_sigma_deg", number(options.tilt_sigma_deg)},
                     {"rejection_sigma", number(options.rejection_sigma)}};
}

void add_frame(Json& json, const Product& product) {
  json["origin"] = nullptr;
  json["map_grid"] = nullptr;
  if (product.origin)
    json["origin"] = {
        {"lat_deg", from_text(fixed(product.origin->latitude_deg, 10))},
        {"lon_deg", from_text(fixed(product.origin->longitude_deg, 10))},
        {"height_ellipsoidal_m", from_text(fixed(product.origin->height_ellipsoidal_m, 6))}};
  const auto earth = Georeference::of(product);
  const std::string grid = earth && *earth ? (*earth)->grid_in_words() : "";
  if (!grid.empty()) json["map_grid"] = grid;
  json["datum"] = clean_utf8(product.datum);
  json["frame"] = nullptr;
  if (const auto& roles = product.solution.frame) {
    const auto name = [&](int point) {
      return clean_utf8(product.problem.point_names[static_cast<std::size_t>(point)]);
    };
    json["frame"] = {{"origin", name(roles->origin)},
                     {"x_axis", name(roles->x_axis)},
                     {"plane", name(roles->plane)}};
  }
}

Json check_object(const survey::CheckReport& check) {
  Json json;
  json["points"] = check.points.size();
  json["same_frame"] = check.same_frame;
  add_axes(json, "rmse", check.rmse_m);
  add_axes(json, "rms_stated_sigma", check.rms_stated_sigma_m);
  json["largest_m"] = number(check.largest_m);
  json["share_within_one_sigma"] = number(check.share_within_one_sigma);
  json["share_within_two_sigma"] = number(check.share_within_two_sigma);
  const bool tested = check.joint_nees_dof > 0;
  json["joint_nees"] = tested ? number(check.joint_nees) : Json(nullptr);
  json["joint_nees_holds"] = tested && check.joint_nees_holds;
  json["joint_nees_dof"] = check.joint_nees_dof;
  json["joint_nees_low"] = tested ? number(check.joint_nees_low) : Json(nullptr);
  json["joint_nees_high"] = tested ? number(check.joint_nees_high) : Json(nullptr);
  const double unknown = std::nan("");
  add_axes(json, "best_fit_rmse",
           check.best_fit_rmse_m.value_or(Eigen::Vector3d::Constant(unknown)));
  json["flat_rmse_u_m"] = check.flat_rmse_u_m ? number(*check.flat_rmse_u_m) : Json(nullptr);
  json["not_measured"] = texts(check.not_measured);
  json["also_control"] = texts(check.also_control);
  return json;
}

Json derived_list(const std::vector<DerivedFigure>& figures) {
  Json list = Json::array();
  for (const DerivedFigure& figure : figures) {
    Json json = {{"kind", figure.kind}, {"points", texts(figure.points)}, {"unit", figure.unit}};
    if (figure.level_m) json["level_m"] = number(*figure.level_m);
    json["value"] = figure.value ? number(figure.value->value) : Json(nullptr);
    json["sigma"] = figure.value ? number(figure.value->sigma) : Json(nullptr);
    list.push_back(json);
  }
  return list;
}

}  // namespace

std::string summary_json(const Product& product) {
  Json json;
  add_adjustment(json, product);
  add_observability(json, product);
  add_common_sigmas(json, product);
  add_point_figures(json, product);
  if (product.check) json["check"] = check_object(*product.check);
  if (!product.derived.empty()) json["derived"] = derived_list(product.derived);
  if (product.paper) add_paper_stages(json, product);
  add_thresholds(json, product.options);
  add_frame(json, product);
  json["version"] = PLUMBLINE_VERSION;
  json["input_sha256"] = Json::object();
  for (const auto& [name, hash] : product.input_sha256)
    json["input_sha256"][clean_utf8(name)] = clean_utf8(hash);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace plumbline::deliver
