// SPDX-License-Identifier: MIT
#include "firmware/deliver/paper_stages.h"

#include <cmath>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

using Json = nlohmann::ordered_json;
using orient::paper::Procedure;

double rounded(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

std::string row(const std::string& name, const std::vector<double>& values, int decimals) {
  std::string line = "  " + name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ');
  for (const double value : values) line += padded(fixed(value, decimals), 11);
  return line + "\n";
}

std::vector<double> pose_figures(const geometry::Pose& pose) {
  const auto angles = geometry::angles_of(pose.ground_from_photo);
  return {pose.centre_m.x(),           pose.centre_m.y(),
          pose.centre_m.z(),           angles.omega_rad * kDegPerRad,
          angles.phi_rad * kDegPerRad, angles.kappa_rad * kDegPerRad};
}

std::string pose_rows(const Product& product, const std::vector<geometry::Pose>& poses) {
  std::string text =
      "  photo             X m        Y m        Z m  omega deg    phi deg  kappa deg\n";
  for (std::size_t i = 0; i < poses.size(); ++i)
    text += row(clean_utf8(product.problem.photos[i].name), pose_figures(poses[i]), 3);
  return text;
}

std::string ending(int iterations, bool converged, double rms_px) {
  return counted(iterations, "iteration", "iterations") + (converged ? "" : ", NOT CONVERGED") +
         ", RMS " + fixed(rms_px, 3) + " px";
}

std::string height_text(const Product& product, const Procedure& p) {
  std::string text = "(1) Heights from the known length (eq. 1, 2)\n";
  text += "  photo       length px        H m       Bz m\n";
  for (std::size_t i = 0; i < p.heights.height_m.size(); ++i)
    text += row(clean_utf8(product.problem.photos[i].name),
                {p.heights.length_px[i], p.heights.height_m[i], p.heights.base_z_m[i]}, 3);
  return text;
}

std::string camera_text(const geometry::InteriorVector& interior) {
  return "f " + fixed(interior[geometry::kFocalLength], 2) + " px, principal point " +
         fixed(interior[geometry::kPrincipalU], 1) + ", " +
         fixed(interior[geometry::kPrincipalV], 1) + " px";
}

std::string relative_text(const Product& product, const Procedure& p) {
  return "(2) Relative orientation of the pairs with the lowest photo, Bz held (eq. 3, 4)\n  " +
         std::to_string(p.relative.conditions) + " conditions, " +
         std::to_string(p.relative.unknowns) + " unknowns, " +
         ending(p.relative.iterations, p.relative.converged, p.relative.rms_px) + "; " +
         camera_text(p.relative.interior) + "\n" + pose_rows(product, p.relative.poses);
}

std::string later_text(const Product& product, const Procedure& p) {
  return "(3) Intersection of the rays (eq. 5)\n  " +
         ending(p.intersection.iterations, p.intersection.converged, p.intersection.rms_px) +
         "\n(4) Scale by the known length: " + fixed(p.model.scale, 5) +
         "; local frame of the three points\n" + "(5) Resection of all photos, points held\n  " +
         ending(p.resection.iterations, p.resection.converged, p.resection.rms_px) + "; " +
         camera_text(p.resection.interior) + "\n(6) Final adjustment of everything\n  " +
         ending(p.adjusted.iterations, p.adjusted.converged, p.adjusted.rms_px) + "; " +
         camera_text(p.adjusted.interior) + "\n" + pose_rows(product, p.adjusted.poses);
}

std::string accuracy_text(const Product& product, const Procedure& p) {
  std::string text = "Standard accuracy (eq. 6), H " + fixed(p.mean_height_m, 3) + " m, B " +
                     fixed(p.longest_base_m, 3) + " m, 1 px: X and Y " +
                     fixed(p.standard.plan_m, 3) + " m, Z " + fixed(p.standard.height_m, 3) +
                     " m\n";
  if (product.check && product.check->flat_rmse_u_m) {
    const Eigen::Vector3d& rmse = product.check->rmse_m;
    text += "Check points, RMSE: X " + fixed(rmse.x(), 3) + ", Y " + fixed(rmse.y(), 3) + ", Z " +
            fixed(rmse.z(), 3) + " m; the flat answer Z = 0 scores " +
            fixed(*product.check->flat_rmse_u_m, 3) + " m in Z" +
            (rmse.z() < *product.check->flat_rmse_u_m ? "" : ", which these heights do not beat") +
            "\n";
  }
  return text;
}

Json photo_list(const Product& product, const std::vector<geometry::Pose>& poses) {
  static constexpr const char* kNames[] = {"x_m",       "y_m",     "z_m",
                                           "omega_deg", "phi_deg", "kappa_deg"};
  Json list = Json::array();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Json photo = {{"photo", clean_utf8(product.problem.photos[i].name)}};
    const std::vector<double> figures = pose_figures(poses[i]);
    for (std::size_t k = 0; k < figures.size(); ++k) photo[kNames[k]] = rounded(figures[k], 7);
    list.push_back(photo);
  }
  return list;
}

Json point_list(const Product& product, const std::vector<Eigen::Vector3d>& points) {
  Json list = Json::array();
  for (std::size_t i = 0; i < points.size(); ++i)
    list.push_back({{"point", clean_utf8(product.problem.point_names[i])},
                    {"x_m", rounded(points[i].x(), 6)},
                    {"y_m", rounded(points[i].y(), 6)},
                    {"z_m", rounded(points[i].z(), 6)}});
  return list;
}

Json camera_object(const geometry::InteriorVector& interior) {
  Json camera;
  for (int i = 0; i < geometry::kInteriorCount; ++i)
    camera[geometry::kInteriorNames[static_cast<std::size_t>(i)]] = rounded(interior[i], 9);
  return camera;
}

template <typename Stage>
Json solved(const char* name, const Stage& stage) {
  return {{"stage", name},
          {"iterations", stage.iterations},
          {"converged", stage.converged},
          {"rms_px", rounded(stage.rms_px, 6)}};
}

Json height_object(const Product& product, const Procedure& p) {
  Json stage = {{"stage", "heights"}};
  for (std::size_t i = 0; i < p.heights.height_m.size(); ++i)
    stage["photos"].push_back({{"photo", clean_utf8(product.problem.photos[i].name)},
                               {"length_px", rounded(p.heights.length_px[i], 4)},
                               {"height_m", rounded(p.heights.height_m[i], 6)},
                               {"base_z_m", rounded(p.heights.base_z_m[i], 6)}});
  return stage;
}

}  // namespace

std::string paper_stages_text(const Product& product) {
  if (!product.paper) return {};
  const Procedure& p = *product.paper;
  return "The published procedure (Kunii and Kumazaki 2018), with declared priors:\n  " +
         p.declared + "\n" + height_text(product, p) + relative_text(product, p) +
         later_text(product, p) + accuracy_text(product, p) + "\n";
}

void add_paper_stages(Json& json, const Product& product) {
  const Procedure& p = *product.paper;
  json["declared_priors"] = clean_utf8(p.declared);
  Json stages = Json::array({height_object(product, p)});
  Json relative = solved("relative_orientation", p.relative);
  relative["conditions"] = p.relative.conditions;
  relative["unknowns"] = p.relative.unknowns;
  relative["camera"] = camera_object(p.relative.interior);
  relative["photos"] = photo_list(product, p.relative.poses);
  stages.push_back(relative);
  Json intersection = solved("intersection", p.intersection);
  intersection["points"] = point_list(product, p.intersection.points);
  stages.push_back(intersection);
  stages.push_back({{"stage", "scale"},
                    {"scale", rounded(p.model.scale, 9)},
                    {"photos", photo_list(product, p.model.poses)},
                    {"points", point_list(product, p.model.points)}});
  Json resection = solved("resection", p.resection);
  resection["camera"] = camera_object(p.resection.interior);
  resection["photos"] = photo_list(product, p.resection.poses);
  stages.push_back(resection);
  Json last = solved("final_adjustment", p.adjusted);
  last["camera"] = camera_object(p.adjusted.interior);
  last["photos"] = photo_list(product, p.adjusted.poses);
  last["points"] = point_list(product, p.adjusted.points);
  stages.push_back(last);
  json["stages"] = stages;
  json["standard_accuracy"] = {{"height_m", rounded(p.mean_height_m, 6)},
                               {"base_m", rounded(p.longest_base_m, 6)},
                               {"sigma_px", 1.0},
                               {"plan_m", rounded(p.standard.plan_m, 6)},
                               {"height_sigma_m", rounded(p.standard.height_m, 6)}};
}

}  // namespace plumbline::deliver
