// SPDX-License-Identifier: MIT
#include "edge/orient/validate.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace plumbline::orient {
namespace {

using geometry::Camera;

bool in_range(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool is_covariance(const Eigen::Matrix3d& m) { return m.allFinite() && m.ldlt().isPositive(); }

Status check_camera(const Camera& camera) {
  if (camera.width_px <= 0 || camera.height_px <= 0) {
    return Error{"The camera has no picture size: give width_px and height_px."};
  }
  if (!camera.interior.allFinite() || !(camera.interior[geometry::kFocalLength] > 0)) {
    return Error{"The camera's focal length must be a positive number of pixels."};
  }
  if ((camera.sigma.array() < 0).any() || camera.sigma.hasNaN()) {
    return Error{"A sigma of the camera is negative or not a number."};
  }
  return Done{};
}

bool is_sigma(double sigma) { return sigma >= 0 && std::isfinite(sigma); }

Status check_gnss(const GnssErrorModel& gnss, const LeverArm& arm) {
  if (!is_sigma(gnss.offset_sigma_horizontal_m) || !is_sigma(gnss.offset_sigma_vertical_m) ||
      !is_sigma(gnss.correlated_sigma_horizontal_m) ||
      !is_sigma(gnss.correlated_sigma_vertical_m) || !is_sigma(gnss.correlation_s)) {
    return Error{"The sigmas and the correlation time of GNSS errors must be numbers from 0 on."};
  }
  if (!arm.in_photo_m.allFinite() || !is_sigma(arm.sigma_m)) {
    return Error{"The lever arm needs three numbers and a sigma from 0 on, in metres."};
  }
  return Done{};
}

Status check_photo(const Photo& photo) {
  const std::string who = "Photo " + photo.name + ": ";
  if (photo.station && !(photo.station->antenna_in_enu_m.allFinite() &&
                         is_covariance(photo.station->covariance_m2))) {
    return Error{who + "its position or the sigma of it is not a number."};
  }
  if (photo.time_s && !std::isfinite(*photo.time_s)) {
    return Error{who + "its time is not a number."};
  }
  if (photo.heading &&
      !(std::isfinite(photo.heading->heading_rad) && photo.heading->sigma_rad > 0)) {
    return Error{who + "its heading needs a number and a positive sigma."};
  }
  if (photo.attitude && (photo.attitude->omega_phi_kappa_rad.hasNaN() ||
                         !(photo.attitude->sigma_rad.array() > 0).all())) {
    return Error{who + "its attitude needs numbers and positive sigmas."};
  }
  return Done{};
}

Status check_observation(const Observation& o, const Problem& problem) {
  if (!in_range(o.photo, problem.photos.size()) || !in_range(o.point, problem.point_names.size())) {
    return Error{"An observation names a photo or point that does not exist."};
  }
  if (!o.pixel.allFinite() || !(o.sigma_px > 0) || !std::isfinite(o.sigma_px)) {
    return Error{"The observation of point " +
                 problem.point_names[static_cast<std::size_t>(o.point)] + " in photo " +
                 problem.photos[static_cast<std::size_t>(o.photo)].name +
                 " needs finite pixels and a positive sigma."};
  }
  return Done{};
}

Status check_known(const Problem& problem) {
  for (const Length& length : problem.lengths) {
    if (!in_range(length.point_a, problem.point_names.size()) ||
        !in_range(length.point_b, problem.point_names.size()) || length.point_a == length.point_b ||
        !(length.metres > 0) || !std::isfinite(length.metres) || !(length.sigma_m >= 0)) {
      return Error{"A known length needs two different points, a positive length and a sigma."};
    }
  }
  for (const Control& control : problem.control) {
    if (!in_range(control.point, problem.point_names.size()) || !control.in_enu_m.allFinite() ||
        !is_covariance(control.covariance_m2)) {
      return Error{"A control point needs finite coordinates and sigmas."};
    }
  }
  return Done{};
}

}  // namespace

Status validate(const Problem& problem) {
  if (auto status = check_camera(problem.camera); !status) return status;
  if (auto status = check_gnss(problem.gnss, problem.lever_arm); !status) return status;
  if (problem.photos.size() < 2) {
    return Error{
        "One photo alone cannot be measured: at least two photos of the same ground from "
        "different places are needed."};
  }
  for (const Photo& photo : problem.photos) {
    if (auto status = check_photo(photo); !status) return status;
  }
  for (const Observation& o : problem.observations) {
    if (auto status = check_observation(o, problem); !status) return status;
  }
  return check_known(problem);
}

}  // namespace plumbline::orient
