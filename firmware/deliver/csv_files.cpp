// SPDX-License-Identifier: MIT
#include "firmware/deliver/csv_files.h"

#include <cmath>
#include <initializer_list>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "firmware/deliver/georeference.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

constexpr int kMetreDecimals = 6;
constexpr int kVarianceDecimals = 12;
constexpr int kAngleDecimals = 7;
constexpr int kPixelDecimals = 4;
constexpr int kLatLonDecimals = 10;

// RFC 4180; a name that starts with # would be read as a comment.
std::string cell(const std::string& name) {
  const std::string clean = clean_utf8(name);
  const bool plain = clean.find_first_of(",\"") == std::string::npos && !clean.empty() &&
                     clean.front() != '#' && clean.front() != ' ' && clean.back() != ' ';
  if (plain) return clean;
  std::string quoted = "\"";
  for (const char c : clean) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string numbers(std::initializer_list<double> values, int decimals) {
  std::string text;
  for (const double value : values) {
    text += ',';
    text += fixed(value, decimals);
  }
  return text;
}

std::string three(const Eigen::Vector3d& v, int decimals) {
  return numbers({v.x(), v.y(), v.z()}, decimals);
}

std::string blanks(int count) { return std::string(static_cast<std::size_t>(count), ','); }

std::string point_cells(const orient::MeasuredPoint& point) {
  const Eigen::Matrix3d& c = point.covariance_m2;
  return three(point.in_enu_m, kMetreDecimals) + three(c.diagonal().cwiseSqrt(), kMetreDecimals) +
         numbers({c(0, 1), c(0, 2), c(1, 2)}, kVarianceDecimals) + "," +
         std::to_string(point.rays) + "," + fixed(point.residual_rms_px, kPixelDecimals);
}

std::string map_cells(const MapPlace& place) {
  return numbers({place.geodetic.latitude_deg, place.geodetic.longitude_deg}, kLatLonDecimals) +
         numbers({place.geodetic.height_ellipsoidal_m}, kMetreDecimals) + "," + place.zone +
         numbers({place.x_north_m, place.y_east_m}, kMetreDecimals);
}

// What the rest checks of the station; an error that nothing would show is left blank.
std::string station_cells(const orient::OrientedPhoto& photo) {
  if (!photo.station_check) return blanks(10);
  const orient::StationCheck& check = *photo.station_check;
  return three(check.redundancy, kPixelDecimals) +
         three(check.minimal_detectable_m, kPixelDecimals) + "," +
         std::to_string(check.directions) +
         numbers({check.statistic, check.critical}, kPixelDecimals) +
         (photo.station_rejected ? ",0" : ",1");
}

std::string photo_cells(const orient::OrientedPhoto& photo) {
  const geometry::OmegaPhiKappa angles = geometry::angles_of(photo.pose.ground_from_photo);
  const Eigen::Vector3d opk(angles.omega_rad, angles.phi_rad, angles.kappa_rad);
  const Eigen::Vector3d sigma_m = photo.covariance.diagonal().head<3>().cwiseSqrt();
  return three(photo.pose.centre_m, kMetreDecimals) + three(opk * kDegPerRad, kAngleDecimals) +
         three(sigma_m, kMetreDecimals) +
         three(photo.sigma_omega_phi_kappa_rad * kDegPerRad, kAngleDecimals) +
         (photo.gnss_residual_m ? three(*photo.gnss_residual_m, kMetreDecimals) : blanks(3)) +
         station_cells(photo);
}

std::string observation_line(const Product& product, std::size_t i) {
  const orient::Observation& observation = product.problem.observations[i];
  const orient::ObservationResidual& residual = product.solution.residuals[i];
  const auto photo = static_cast<std::size_t>(observation.photo);
  const auto point = static_cast<std::size_t>(observation.point);
  const bool known =
      product.solution.photos[photo].oriented && product.solution.points[point].measured;
  const double sigma_px = residual.sigma_px > 0.0 ? residual.sigma_px : observation.sigma_px;
  return cell(product.problem.photos[photo].name) + "," + cell(product.problem.point_names[point]) +
         numbers({observation.pixel.x(), observation.pixel.y(), sigma_px}, kPixelDecimals) +
         (known ? numbers({residual.residual_px.x(), residual.residual_px.y()}, kPixelDecimals)
                : blanks(2)) +
         (residual.used ? ",1" : ",0") +
         numbers({residual.redundancy.x(), residual.redundancy.y(), residual.w.x(), residual.w.y()},
                 kPixelDecimals) +
         "\n";
}

}  // namespace

Result<std::string> points_csv(const Product& product) {
  const auto earth = Georeference::of(product);
  if (!earth) return earth.error();
  std::string text =
      "point,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m,cov_en_m2,cov_eu_m2,cov_nu_m2,rays,"
      "residual_rms_px";
  if (*earth) text += ",lat_deg,lon_deg,height_ellipsoidal_m,zone,x_north_m,y_east_m";
  text += "\n";
  for (std::size_t i = 0; i < product.solution.points.size(); ++i) {
    const orient::MeasuredPoint& point = product.solution.points[i];
    if (!point.measured) continue;
    text += cell(product.problem.point_names[i]) + point_cells(point);
    if (*earth) {
      const auto place = (*earth)->place_of(point.in_enu_m);
      text += place ? map_cells(*place) : blanks(6);
    }
    text += "\n";
  }
  return text;
}

std::string photos_csv(const Product& product) {
  std::string text =
      "photo,e_m,n_m,u_m,omega_deg,phi_deg,kappa_deg,sigma_e_m,sigma_n_m,sigma_u_m,"
      "sigma_omega_deg,sigma_phi_deg,sigma_kappa_deg,gnss_residual_e_m,gnss_residual_n_m,"
      "gnss_residual_u_m,gnss_redundancy_e,gnss_redundancy_n,gnss_redundancy_u,gnss_detectable_e_m,"
      "gnss_detectable_n_m,gnss_detectable_u_m,gnss_directions,gnss_statistic,gnss_critical,"
      "gnss_used\n";
  for (std::size_t i = 0; i < product.solution.photos.size(); ++i) {
    const orient::OrientedPhoto& photo = product.solution.photos[i];
    text += cell(product.problem.photos[i].name) +
            (photo.oriented ? photo_cells(photo) : blanks(25)) + "\n";
  }
  return text;
}

std::string observations_csv(const Product& product) {
  std::string text =
      "photo,point,u_px,v_px,sigma_px,residual_u_px,residual_v_px,used,"
      "redundancy_u,redundancy_v,w_u,w_v\n";
  for (std::size_t i = 0; i < product.problem.observations.size(); ++i)
    text += observation_line(product, i);
  return text;
}

std::string check_csv(const survey::CheckReport& check) {
  std::string text =
      "point,difference_e_m,difference_n_m,difference_u_m,sigma_e_m,sigma_n_m,sigma_u_m,"
      "best_fit_difference_e_m,best_fit_difference_n_m,best_fit_difference_u_m\n";
  for (const survey::CheckedPoint& point : check.points)
    text +=
        cell(point.point) + three(point.difference_m, kMetreDecimals) +
        three(point.sigma_m, kMetreDecimals) +
        (check.best_fit_rmse_m ? three(point.best_fit_difference_m, kMetreDecimals) : blanks(3)) +
        "\n";
  for (const std::string& name : check.not_measured) text += cell(name) + blanks(9) + "\n";
  return text;
}

}  // namespace plumbline::deliver
