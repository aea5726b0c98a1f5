// SPDX-License-Identifier: MIT
#include "edge/orient/findings/solution_of.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/findings/correlations.h"
#include "edge/orient/findings/findings.h"
#include "edge/orient/findings/observation_residuals.h"
#include "edge/orient/network/stations.h"

namespace plumbline::orient {
namespace {

constexpr double kWorthSaying = 1.2;
constexpr double kBendingTurn = 0.01;  // rad: its arc is 5e-5 of its radius

geometry::Camera adjusted_camera(const Finished& f) {
  geometry::Camera camera = f.network.problem->camera;
  camera.interior = f.state.interior;
  const geometry::InteriorMatrix covariance =
      f.bars.common().topLeftCorner<geometry::kInteriorCount, geometry::kInteriorCount>();
  camera.sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  camera.covariance = covariance;
  if (f.network.shared_mask[kLineTime] != 0) {
    camera.line_time_us = f.state.line_time_s / kSecondsPerMicrosecond;
    camera.line_time_sigma_us =
        std::sqrt(f.bars.common()(kLineTime, kLineTime)) / kSecondsPerMicrosecond;
  }
  return camera;
}

std::optional<TimeEstimate> time_estimate(const Finished& f, SharedColumn column, double seconds) {
  if (f.network.shared_mask[column] == 0) return std::nullopt;
  return TimeEstimate{seconds, std::sqrt(std::max(0.0, f.bars.common()(column, column)))};
}

OrientedPhoto oriented(const Finished& f, int slot) {
  OrientedPhoto photo;
  photo.oriented = true;
  photo.pose = f.state.poses[at(slot)];
  const int column = f.network.layout.photo(slot);
  photo.covariance = f.bars.common().block<6, 6>(column, column);
  const auto angles = geometry::angles_of(photo.pose.ground_from_photo);
  const Eigen::Matrix3d by_increment = geometry::angles_by_ground_increment(angles);
  photo.sigma_omega_phi_kappa_rad =
      (by_increment * photo.covariance.bottomRightCorner<3, 3>() * by_increment.transpose())
          .diagonal()
          .cwiseMax(0)
          .cwiseSqrt();
  if (const auto& station = f.network.photo(slot).station) {
    const Eigen::Vector3d late = f.state.delay_s * velocity_in_enu_m_s(f.network, slot);
    photo.gnss_residual_m = station->antenna_in_enu_m + late - photo.pose.centre_m -
                            photo.pose.ground_from_photo * f.network.problem->lever_arm.in_photo_m;
    photo.station_rejected = weight_of(f.terms.station_weights, slot) == 0;
  }
  return photo;
}

void fill_points(const Finished& f, const std::vector<Eigen::Matrix3d>& covariances,
                 const LocalFrameFit& frame, Solution& solution) {
  solution.points.resize(at(f.network.points()));
  for (int p = 0; p < f.network.points(); ++p) {
    MeasuredPoint& point = solution.points[at(p)];
    point.measured = f.bars.point(p).measured;
    if (!point.measured) continue;
    point.in_enu_m = f.state.points[at(p)];
    point.covariance_m2 = covariances[at(p)];
    point.local_covariance_m2 = frame.local_covariance_m2[at(p)];
    double squares = 0;
    for (int k = f.network.first_ray[at(p)]; k < f.network.first_ray[at(p) + 1]; ++k) {
      const auto residual = residual_of(f.network.rays[at(k)], f.state);
      if (!f.network.rays[at(k)].used || !residual) continue;
      ++point.rays;
      squares += residual->squaredNorm();
    }
    point.residual_rms_px = point.rays > 0 ? std::sqrt(squares / point.rays) : 0;
  }
}

void summarise_images(const Finished& f, const Solution& solution, Summary& summary) {
  double squares = 0, variance = 0;
  int used = 0;
  for (const Ray& ray : f.network.rays) {
    if (!ray.used) {
      ++summary.observations_rejected;
      continue;
    }
    squares += solution.residuals[at(ray.observation)].residual_px.squaredNorm();
    variance += ray.sigma_px * ray.sigma_px;
    ++used;
  }
  if (used == 0) return;
  summary.reprojection_rms_px = std::sqrt(squares / used);
  summary.image_sigma_px = std::sqrt(variance / used);
}

void summarise_fits(const Finished& f, Summary& summary) {
  GroupFit total;
  for (const auto& [name, fit] : f.fits) {
    total.squares += fit.squares;
    total.redundancy += fit.redundancy;
    if (name == "datum") continue;
    summary.sigma0_by_group[name] =
        fit.redundancy > 1e-6 ? std::sqrt(fit.squares / fit.redundancy) : 0;
  }
  summary.sigma0 = total.redundancy > 1e-6 ? std::sqrt(total.squares / total.redundancy) : 0;
  summary.redundancy = static_cast<int>(std::lround(total.redundancy));
}

// Points along the arc of a poorly known azimuth look, by a linear fit, as if scale and level were
// unknown too; those are not angles about the vertical, and are as the straight covariance has
// them.
void take_off_arc(const CommonSigmas& straight, CommonSigmas& common) {
  if (!(common.azimuth_rad > kBendingTurn)) return;
  common.scale = straight.scale;
  common.tilt_rad = straight.tilt_rad;
}

void warn_of_correlation(Summary& summary) {
  const double widened = std::sqrt(summary.image_design_effect);
  if (widened < kWorthSaying) return;
  char sentence[320];
  std::snprintf(sentence, sizeof sentence,
                "Image errors are alike where points are near each other (lens stabilisation, "
                "rolling shutter, shadows or the like), or ask for a camera against what is known "
                "of it: the error bars of ties were widened by %.1f to allow for it.",
                widened);
  summary.warnings.push_back(sentence);
}

void warn_of_left_out(const Finished& f, const Solution& solution, Summary& summary) {
  for (std::size_t i = 0; i < solution.photos.size(); ++i) {
    if (solution.photos[i].oriented) continue;
    summary.warnings.push_back("Photo " + f.network.problem->photos[i].name +
                               " shares too few points with the others and was left out.");
  }
}

}  // namespace

Solution solution_of(const Finished& f, const Options& options) {
  Solution solution;
  solution.camera = adjusted_camera(f);
  solution.photos.resize(f.network.problem->photos.size());
  for (int slot = 0; slot < f.network.slots(); ++slot) {
    solution.photos[at(f.network.photo_of_slot[at(slot)])] = oriented(f, slot);
  }
  solution.residuals = observation_residuals(f);
  const std::vector<Eigen::Matrix3d> covariances = f.bars.point_covariances();
  const LocalFrameFit frame = fit_local_frame(f.state, f.bars, covariances);
  fill_points(f, covariances, frame, solution);

  Summary& summary = solution.summary;
  summary.converged = f.converged;
  if (!f.converged) {
    summary.warnings.emplace_back(
        "The adjustment did not converge: neither figures nor error bars may be used.");
  }
  summary.iterations = f.iterations;
  summarise_images(f, solution, summary);
  summarise_fits(f, summary);
  summary.image_design_effect = f.network.ties_design_effect;
  summary.flying_height_m = flying_height(f.network, f.state);
  const Evidence evidence{f.network, f.state, f.terms, f.bars, frame};
  summary.common = common_sigmas(evidence, summary.flying_height_m);
  const LocalFrameFit straight_frame =
      fit_local_frame(f.state, f.covariance, f.covariance.point_covariances());
  const Evidence straight{f.network, f.state, f.terms, f.covariance, straight_frame};
  take_off_arc(common_sigmas(straight, summary.flying_height_m), summary.common);
  summary.delay = time_estimate(f, kDelay, f.state.delay_s);
  summary.line_time = time_estimate(f, kLineTime, f.state.line_time_s);
  summary.unobservable = unobservable(evidence, summary.common, options);
  summary.correlations = correlations(straight, options.min_correlation);
  summary.weakest = weakest_combinations(straight);
  warn_of_left_out(f, solution, summary);
  add_findings(f, straight_frame, solution);
  warn_of_correlation(summary);
  for (std::string& sentence : cautions(evidence, summary.common)) {
    summary.warnings.push_back(std::move(sentence));
  }
  solution.covariances = std::make_shared<NetworkCovariance>(f.bars);
  return solution;
}

}  // namespace plumbline::orient
