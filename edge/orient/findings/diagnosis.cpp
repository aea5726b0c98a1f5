// SPDX-License-Identifier: MIT
#include "edge/orient/findings/diagnosis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "edge/base/median.h"
#include "edge/base/units.h"
#include "edge/orient/findings/formatted.h"
#include "edge/orient/network/camera_prior.h"

namespace plumbline::orient {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Stations with a white sigma beyond this are no surveying evidence for scale and position.
constexpr double kPoorStationM = 0.5;

std::string in_degrees(double sigma_rad) { return two_digits(sigma_rad * kDegPerRad) + " degrees"; }

// The sigma of the common compass, where headings are given: their mean's own prior.
double heading_sigma(const Network& network) {
  double smallest = kInfinity;
  for (int slot = 0; slot < network.slots(); ++slot) {
    const Photo& photo = network.photo(slot);
    if (photo.heading) smallest = std::min(smallest, photo.heading->sigma_rad);
  }
  return smallest;
}

// Do the data reduce the variance of what the prior alone carries by too little?
bool rests_on_prior(double sigma, double prior_sigma, const Options& options) {
  return std::isfinite(prior_sigma) && prior_sigma > 0 &&
         sigma * sigma > (1 - options.min_variance_reduction) * prior_sigma * prior_sigma;
}

void judge_azimuth(const Evidence& e, const CommonSigmas& s, const Options& options,
                   std::vector<Unobservable>& out) {
  const char* const advice =
      "The photo stations lie (nearly) on one line, about which they cannot fix a turn; a "
      "side-step of 5 to 10 m, a heading, or a control point away from the foot fixes it. Until "
      "then absolute positions grow worse with distance from the foot of the climb; distances and "
      "shapes do not.";
  if (!std::isfinite(s.azimuth_rad)) {
    out.push_back({"azimuth",
                   "The azimuth of the result is not known at all: nothing in the input "
                   "gives a direction. GNSS positions with a side-step, a heading, or "
                   "two control points fix it."});
  } else if (s.azimuth_rad > options.max_azimuth_sigma_deg * kRadPerDeg) {
    out.push_back({"azimuth", "The azimuth of the result is known only to " +
                                  in_degrees(s.azimuth_rad) + " (sigma). " + advice});
  } else if (rests_on_prior(s.azimuth_rad, heading_sigma(e.network), options)) {
    out.push_back({"azimuth", "The azimuth of the result rests on the given heading alone (" +
                                  in_degrees(s.azimuth_rad) + "). " + advice});
  }
}

void judge_tilt(const CommonSigmas& s, const Options& options, std::vector<Unobservable>& out) {
  if (s.tilt_rad <= options.max_tilt_sigma_deg * kRadPerDeg) return;
  if (!std::isfinite(s.tilt_rad)) {
    out.push_back({"tilt",
                   "The level of the result is not known: fewer than three points off one "
                   "line were measured. Measure more points."});
    return;
  }
  out.push_back({"tilt", "The level of the result is known only to " + in_degrees(s.tilt_rad) +
                             " (sigma): heights tilt with it. RTK positions, or three control "
                             "points, fix it."});
}

void judge_focal_length(const Evidence& e, const CommonSigmas& s, const Options& options,
                        std::vector<Unobservable>& out) {
  const double f = e.state.interior[geometry::kFocalLength];
  const double prior = prior_sigmas(e.network.problem->camera)[geometry::kFocalLength] / f;
  if (s.focal_length > options.max_focal_length_sigma) {
    out.push_back(
        {"focal_length",
         formatted("The focal length is known only to %.2g %% (sigma), and flying height and "
                   "scale with it. A calibrated camera, a side-step, or a known length fixes "
                   "it.",
                   100 * s.focal_length)});
  } else if (rests_on_prior(s.focal_length, prior, options)) {
    out.push_back({"focal_length",
                   formatted("The photos do not test the focal length: it rests on the calibration "
                             "given (%.2g %%). A side-step, tilted photos or a known length would "
                             "check it.",
                             100 * s.focal_length)});
  }
}

void judge_scale(const CommonSigmas& s, const Options& options, std::vector<Unobservable>& out) {
  if (!std::isfinite(s.scale)) {
    out.push_back(
        {"scale",
         formatted("Nothing in the input gives the scale: all lengths are in units of 1/%.0f "
                   "of the height of one photo. One known length (--length A,B,METRES) or "
                   "GNSS positions fix it.",
                   100.0)});
  } else if (s.scale > options.max_scale_sigma) {
    out.push_back({"scale", formatted("The scale is known only to %.2g %% (sigma). A known length "
                                      "(--length A,B,METRES) or RTK positions fix it.",
                                      100 * s.scale)});
  }
}

void judge_position(const Evidence& e, const CommonSigmas& s, const Options& options,
                    std::vector<Unobservable>& out) {
  const GnssErrorModel& gnss = e.network.problem->gnss;
  if (!std::isfinite(s.position_m)) {
    out.push_back({"position",
                   "Nothing in the input gives the absolute position: coordinates are "
                   "relative only. GNSS positions or a control point fix it."});
  } else if (s.position_m > options.max_position_sigma_m) {
    out.push_back(
        {"position",
         "The absolute position is known only to " + two_digits(s.position_m) +
             " m (sigma): coordinates and heights are relative only. RTK positions of known height "
             "reference, or a control point, fix it."});
  } else if (std::max(gnss.offset_sigma_horizontal_m, gnss.offset_sigma_vertical_m) > 0 &&
             e.network.problem->control.empty()) {
    out.push_back(
        {"gnss_offset",
         formatted("An error common to all GNSS positions (sigma %.2g m in plan, %.2g m in height) "
                   "cannot be seen by the photos: it shifts all points alike. Differences between "
                   "points are not touched by it; a control point removes it.",
                   gnss.offset_sigma_horizontal_m, gnss.offset_sigma_vertical_m)});
  }
}

// A prior that alone carries it: the photos and positions say nothing of it.
void judge_times(const Evidence& e, const Options& options, std::vector<Unobservable>& out) {
  const auto sigma = [&](SharedColumn column) {
    return std::sqrt(std::max(0.0, e.covariance.common()(column, column)));
  };
  const double delay_prior = e.network.problem->delay.sigma_s;
  if (e.network.shared_mask[kDelay] != 0 && rests_on_prior(sigma(kDelay), delay_prior, options)) {
    out.push_back(
        {"delay", formatted("The delay between camera and GNSS rests on what was given "
                            "(%.2g s): at one velocity it shifts all positions alike. Photos "
                            "at different speeds, some at rest, or control points fix it.",
                            delay_prior)});
  }
  const double line_prior = e.network.problem->camera.line_time_sigma_us * kSecondsPerMicrosecond;
  if (e.network.shared_mask[kLineTime] != 0 &&
      rests_on_prior(sigma(kLineTime), line_prior, options)) {
    out.push_back(
        {"line_time", formatted("The line time of the rolling shutter rests on what was given "
                                "(%.2g us). Photos at different speeds would show it.",
                                line_prior / kSecondsPerMicrosecond)});
  }
}

void judge_height(const CommonSigmas& s, const Options& options, std::vector<Unobservable>& out) {
  if (s.height <= options.max_height_sigma) return;
  out.push_back(
      {"height", formatted("Heights of the points are known only to %.2g %% of the flying "
                           "height (median sigma): the base is too short or too much in line "
                           "with the points. Climb further or step aside.",
                           100 * s.height)});
}

}  // namespace

CommonSigmas common_sigmas(const Evidence& e, double flying_height_m) {
  const auto& c = e.frame.common_covariance;
  const DatumDefect defect = datum_defect(e.network, e.terms);
  CommonSigmas sigmas;
  if (!e.frame.determined) return {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, 0};
  sigmas.position_m = defect.translation ? kInfinity : std::sqrt(c.diagonal().head<3>().maxCoeff());
  sigmas.azimuth_rad = defect.azimuth ? kInfinity : std::sqrt(c(5, 5));
  sigmas.scale = defect.scale ? kInfinity : std::sqrt(c(6, 6));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> tilt(c.block<2, 2>(3, 3));
  sigmas.tilt_rad = std::sqrt(std::max(0.0, tilt.eigenvalues().maxCoeff()));
  sigmas.focal_length = std::sqrt(e.covariance.common()(0, 0)) / e.state.interior[0];
  std::vector<double> heights;
  for (int p = 0; p < e.covariance.points(); ++p) {
    if (!e.covariance.point(p).measured) continue;
    heights.push_back(std::sqrt(std::max(0.0, e.frame.local_covariance_m2[at(p)](2, 2))));
  }
  sigmas.height =
      flying_height_m > 0 ? upper_median(std::move(heights)) / flying_height_m : kInfinity;
  return sigmas;
}

std::vector<Unobservable> unobservable(const Evidence& evidence, const CommonSigmas& sigmas,
                                       const Options& options) {
  std::vector<Unobservable> out;
  judge_azimuth(evidence, sigmas, options, out);
  judge_tilt(sigmas, options, out);
  judge_focal_length(evidence, sigmas, options, out);
  judge_scale(sigmas, options, out);
  judge_height(sigmas, options, out);
  judge_position(evidence, sigmas, options, out);
  judge_times(evidence, options, out);
  return out;
}

std::vector<std::string> cautions(const Evidence& e, const CommonSigmas& sigmas) {
  std::vector<std::string> sentences;
  std::vector<double> white;
  for (const int slot : station_slots(e.network, e.terms)) {
    white.push_back(std::sqrt(e.network.photo(slot).station->covariance_m2.diagonal().maxCoeff()));
  }
  const double poor = upper_median(white);
  const bool other_scale =
      !e.network.problem->lengths.empty() || e.network.problem->control.size() >= 2;
  if (poor > kPoorStationM && std::isfinite(sigmas.scale) && !other_scale) {
    sentences.push_back(formatted(
        "Scale (%.2g %%), azimuth, level and absolute position (%s m) rest only on GNSS "
        "positions of %s m sigma; ratios of lengths and the shape of the ground do not.",
        100 * sigmas.scale, two_digits(sigmas.position_m).c_str(), two_digits(poor).c_str()));
  } else if (poor > kPoorStationM && std::isfinite(sigmas.position_m) &&
             e.network.problem->control.empty()) {
    sentences.push_back(
        formatted("The absolute position (%s m) rests only on GNSS positions of %s m sigma.",
                  two_digits(sigmas.position_m).c_str(), two_digits(poor).c_str()));
  }
  return sentences;
}

}  // namespace plumbline::orient
