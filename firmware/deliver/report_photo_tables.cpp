// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "firmware/deliver/html.h"
#include "firmware/deliver/report_tables.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

const std::string kUnknown = "\xe2\x80\x93";

Row station_row(const std::string& name, const orient::OrientedPhoto& photo) {
  Row row = {name};
  if (!photo.oriented) {
    row.push_back("not oriented");
    row.insert(row.end(), 8, "");
    return row;
  }
  add_axes(row, photo.pose.centre_m, 3);
  add_axes(row, photo.covariance.diagonal().head<3>().cwiseSqrt(), 3);
  add_axes(row, photo.gnss_residual_m.value_or(Eigen::Vector3d::Constant(std::nan(""))), 3);
  if (photo.station_rejected) row[0] += " (GNSS rejected)";
  return row;
}

Row attitude_row(const std::string& name, const orient::OrientedPhoto& photo) {
  const geometry::OmegaPhiKappa angles = geometry::angles_of(photo.pose.ground_from_photo);
  Row row = {name};
  add_axes(row, Eigen::Vector3d(angles.omega_rad, angles.phi_rad, angles.kappa_rad) * kDegPerRad,
           4);
  add_axes(row, photo.sigma_omega_phi_kappa_rad * kDegPerRad, 4);
  return row;
}

struct Parameter {
  const char* name;
  int decimals;
};

constexpr std::array<Parameter, geometry::kInteriorCount> kParameters = {{
    {"Focal length (px)", 2},
    {"Principal point u (px)", 2},
    {"Principal point v (px)", 2},
    {"Affinity", 7},
    {"Skew", 7},
    {"Radial k1", 6},
    {"Radial k2", 6},
    {"Radial k3", 6},
    {"Tangential p1", 7},
    {"Tangential p2", 7},
}};

double sigma_of(const geometry::Camera& camera, int i) {
  return camera.covariance ? std::sqrt((*camera.covariance)(i, i)) : camera.sigma[i];
}

std::string correlation_with_focal_length(const geometry::Camera& camera, int i) {
  if (!camera.covariance || i == geometry::kFocalLength) return "";
  const double product = sigma_of(camera, i) * sigma_of(camera, geometry::kFocalLength);
  if (!(product > 0.0)) return "";
  return fixed((*camera.covariance)(i, geometry::kFocalLength) / product, 2);
}

}  // namespace

void add_axes(Row& row, const Eigen::Vector3d& value, int decimals) {
  for (int axis = 0; axis < 3; ++axis) row.push_back(fixed_or(value[axis], decimals, kUnknown));
}

std::string station_table(const Product& product) {
  Table table;
  table.caption = "Photo stations, and the GNSS positions against them (measured minus adjusted)";
  table.head = {"Photo",        "E|m",          "N|m",      "U|m",      kSigma + "E|m",
                kSigma + "N|m", kSigma + "U|m", "GNSS E|m", "GNSS N|m", "GNSS U|m"};
  for (std::size_t i = 0; i < product.solution.photos.size(); ++i)
    table.rows.push_back(station_row(product.problem.photos[i].name, product.solution.photos[i]));
  return html_table(table);
}

std::string attitude_table(const Product& product) {
  Table table;
  table.caption =
      "Attitudes: omega, phi, kappa (about x, y, z; zero looks straight down, top north)";
  table.head = {"Photo",
                "omega|deg",
                "phi|deg",
                "kappa|deg",
                kSigma + "omega|deg",
                kSigma + "phi|deg",
                kSigma + "kappa|deg"};
  for (const int i : oriented_photos(product))
    table.rows.push_back(attitude_row(product.problem.photos[static_cast<std::size_t>(i)].name,
                                      product.solution.photos[static_cast<std::size_t>(i)]));
  return html_table(table);
}

std::string camera_table(const Product& product) {
  const geometry::Camera& camera = product.solution.camera;
  Table table;
  table.caption = "Camera " + camera.name + ", " + std::to_string(camera.width_px) + " x " +
                  std::to_string(camera.height_px) + " px, as adjusted";
  table.head = {"Parameter", "Before", "After", kSigma + "after", "Correlation with focal length"};
  for (int i = 0; i < geometry::kInteriorCount; ++i) {
    const Parameter& parameter = kParameters[static_cast<std::size_t>(i)];
    const double sigma = sigma_of(camera, i);
    table.rows.push_back({parameter.name,
                          fixed(product.problem.camera.interior[i], parameter.decimals),
                          fixed(camera.interior[i], parameter.decimals),
                          sigma == 0.0 ? "held fixed" : fixed_or(sigma, parameter.decimals, "free"),
                          correlation_with_focal_length(camera, i)});
  }
  return html_table(table);
}

std::string group_table(const Product& product) {
  Table table;
  table.caption = "Does each group of observations fit its own sigma? (1 = exactly)";
  table.head = {"Observations", "sigma0"};
  for (const auto& [group, sigma0] : product.solution.summary.sigma0_by_group)
    table.rows.push_back({group, fixed_or(sigma0, 2, kUnknown)});
  return html_table(table);
}

std::string input_table(const Product& product) {
  Table table;
  table.head = {"File", "SHA-256"};
  table.text_columns = 2;
  for (const auto& [name, hash] : product.input_sha256) table.rows.push_back({name, hash});
  return html_table(table);
}

}  // namespace plumbline::deliver
