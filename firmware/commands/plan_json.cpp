// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "edge/base/index.h"
#include "firmware/commands/plan_output.h"

namespace plumbline::commands {
namespace {

using Json = nlohmann::ordered_json;

Json number(std::optional<double> value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

void add_sigmas(Json& json, const plan::GroundSigma& sigma, bool georeferenced) {
  const plan::Sigma& counts = georeferenced ? sigma.absolute : sigma.local;
  json["sigma_plan_m"] = number(counts.plan_m);
  json["sigma_height_m"] = number(counts.height_m);
  json["sigma_plan_local_m"] = number(sigma.local.plan_m);
  json["sigma_height_local_m"] = number(sigma.local.height_m);
  json["sigma_plan_absolute_m"] = number(sigma.absolute.plan_m);
  json["sigma_height_absolute_m"] = number(sigma.absolute.height_m);
}

Json ring_json(const plan::RingSigma& ring, bool georeferenced) {
  Json json = {{"from_m", ring.ring.from_m}, {"to_m", ring.ring.to_m}};
  add_sigmas(json, ring.sigma, georeferenced);
  json["climb_formula_height_m"] = number(ring.climb_formula_height_m);
  json["seen"] = ring.seen;
  return json;
}

Json advice_json(const plan::Advice& advice, bool with_goal) {
  Json json = {{"change", advice.change.what},
               {"options", advice.change.options},
               {"cost_s", advice.change.cost_s},
               {"sigma_plan_m", number(advice.worst.plan_m)},
               {"sigma_height_m", number(advice.worst.height_m)},
               {"azimuth_deg", number(advice.azimuth_deg)},
               {"unobservable", advice.unobservable}};
  json["reaches_goal"] = with_goal ? Json(advice.reaches_goal) : Json(nullptr);
  return json;
}

Json flight_json(const plan::Flight& flight, const plan::Summary& summary) {
  Json places = Json::array();
  for (const auto& place : flight.all_m()) places.push_back({place.x(), place.y(), place.z()});
  return {{"photos", flight.photos()},
          {"taken", flight.taken_m.size()},
          {"lowest_m", plan::lowest_m(flight)},
          {"highest_m", plan::highest_m(flight)},
          {"places_enu_m", places},
          {"duration_s", summary.duration_s}};
}

Json assumed_json(const plan::Options& options) {
  Json rtk = nullptr;
  if (options.rtk) rtk = {options.rtk->sigma_horizontal_m, options.rtk->sigma_vertical_m};
  return {{"sigma_px", options.sigma_px},
          {"ties", options.ties},
          {"rtk_m", rtk},
          {"heading_sigma_deg", number(options.heading_sigma_deg)},
          {"known_length_m", number(options.known_length_m)},
          {"known_length_sigma_m", options.length_sigma_m},
          {"control_points", options.control_points},
          {"control_sigma_m", options.control_sigma_m},
          {"wander_m", options.wander_m},
          {"tilt_deg", options.tilt_deg},
          {"tilt_prior_deg", options.adjustment.tilt_sigma_deg},
          {"relief_m", options.relief_m},
          {"ceiling_m", options.ceiling_m},
          {"floor_m", options.floor_m}};
}

Json costs_json(const plan::Costs& costs) {
  return {{"climb_rate_m_s", costs.climb_rate_m_s},
          {"aside_rate_m_s", costs.aside_rate_m_s},
          {"stop_s", costs.stop_s},
          {"heading_2deg_s", costs.heading_2deg_s},
          {"heading_1deg_s", costs.heading_1deg_s},
          {"known_length_s", costs.length_s},
          {"control_point_s", costs.control_s}};
}

void add_rings(Json& json, const plan::Prediction& prediction) {
  json["rings"] = Json::array();
  for (const auto& ring : prediction.rings) {
    json["rings"].push_back(ring_json(ring, prediction.georeferenced));
  }
  json["foot"] = Json::object();
  add_sigmas(json["foot"], prediction.foot, prediction.georeferenced);
}

void add_common(Json& json, const plan::Prediction& prediction, double focal_length_px) {
  json["azimuth_deg"] = number(prediction.azimuth_deg);
  json["tilt_deg"] = number(prediction.tilt_deg);
  json["focal_length_px"] = number(prediction.focal_length_px);
  json["focal_length"] = number(prediction.focal_length_px / focal_length_px);
  json["scale"] = number(prediction.scale);
  json["position_m"] = number(prediction.position_m);
  json["unobservable"] = Json::array();
  json["unobservable_explained"] = Json::object();
  for (const auto& item : prediction.unobservable) {
    json["unobservable"].push_back(item.name);
    json["unobservable_explained"][item.name] = item.sentence;
  }
}

Json standard_json(const plan::Summary& summary, double sigma_px) {
  if (!summary.standard_accuracy) return nullptr;
  return {{"sigma_plan_m", number(summary.standard_accuracy->plan_m)},
          {"sigma_height_m", number(summary.standard_accuracy->height_m)},
          {"flying_height_m", summary.mean_height_m},
          {"base_m", summary.base_m},
          {"sigma_px", sigma_px}};
}

void add_advice(Json& json, const plan::Summary& summary, const plan::Options& options) {
  const bool with_goal = options.goal_m.has_value();
  const auto chosen = [&](const std::optional<int>& index) {
    return index ? advice_json(summary.advice[at(*index)], with_goal) : Json(nullptr);
  };
  json["goal_m"] = number(options.goal_m);
  json["goal_reached"] = summary.goal_reached ? Json(*summary.goal_reached) : Json(nullptr);
  json["advice"] = Json::array();
  for (const auto& advice : summary.advice)
    json["advice"].push_back(advice_json(advice, with_goal));
  json["cheapest"] = chosen(summary.cheapest);
  json["best"] = chosen(summary.best);
  json["sentence"] = summary.sentence;
}

}  // namespace

std::string plan_json(const plan::Summary& summary, const plan::Flight& flight,
                      const plan::Options& options) {
  const plan::Prediction& prediction = summary.flight;
  Json json = {{"photos", prediction.photos},
               {"sigmas_are", prediction.georeferenced ? "absolute" : "local"},
               {"radius_m", summary.radius_m},
               {"sigma_plan_m", number(summary.worst.plan_m)},
               {"sigma_height_m", number(summary.worst.height_m)}};
  add_rings(json, prediction);
  add_common(json, prediction, options.camera.interior[geometry::kFocalLength]);
  json["standard_accuracy"] = standard_json(summary, options.sigma_px);
  add_advice(json, summary, options);
  json["flight"] = flight_json(flight, summary);
  json["assumed"] = assumed_json(options);
  json["costs"] = costs_json(options.costs);
  return json.dump() + "\n";
}

}  // namespace plumbline::commands
