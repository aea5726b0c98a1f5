// SPDX-License-Identifier: MIT
#include "edge/orient/network/terms.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/network/camera_prior.h"
#include "edge/orient/network/datum_terms.h"
#include "edge/orient/network/stations.h"
#include "edge/orient/network/term_parts.h"

namespace plumbline::orient {
namespace {

using geometry::kInteriorCount;

// Headings share one compass; this part of its sigma is taken as new in each photo.
constexpr double kOwnHeadingShare = 0.2;
constexpr double kLeastSigmaM = 1e-4;

Term camera_term(const Network& network, const State& state, const TermOptions& options) {
  Term term{"camera", range(0, kInteriorCount), {}, {}, {}};
  term.residual = state.interior - network.problem->camera.interior;
  term.jacobian = geometry::InteriorMatrix::Identity();
  term.information = prior_information(believed_camera(network, options));
  if (options.bridle_interior) term.information += bridle_information(network.problem->camera);
  return term;
}

void add_line_time(const Network& network, const State& state, std::vector<Term>& terms) {
  if (network.shared_mask[kLineTime] == 0) return;
  const geometry::Camera& camera = network.problem->camera;
  Term term = scalar_term("camera", {kLineTime},
                          state.line_time_s - camera.line_time_us * kSecondsPerMicrosecond,
                          camera.line_time_sigma_us * kSecondsPerMicrosecond);
  term.jacobian(0, 0) = 1;
  terms.push_back(std::move(term));
}

void add_delay(const Network& network, const State& state, std::vector<Term>& terms) {
  if (network.shared_mask[kDelay] == 0) return;
  const Delay& delay = network.problem->delay;
  Term term = scalar_term("delay", {kDelay}, state.delay_s - delay.seconds, delay.sigma_s);
  term.jacobian(0, 0) = 1;
  terms.push_back(std::move(term));
}

std::vector<int> pose_columns(const Network& network, const std::vector<int>& slots) {
  std::vector<int> columns;
  for (const int slot : slots) {
    for (int i = 0; i < Layout::kPose; ++i) columns.push_back(network.layout.photo(slot) + i);
  }
  return columns;
}

// Antenna at the exposure = C + R l; a delay of d seconds earlier, when the station was taken, it
// was V d behind. For R <- exp([r]x) R the derivative by r is -[R l]x. The velocity is taken as
// known: 0.1 m/s wrong at a delay of 20 ms is 2 mm.
void add_stations(const Network& network, const State& state, const TermOptions& options,
                  std::vector<Term>& terms) {
  const std::vector<int> slots = station_slots(network, options);
  if (slots.empty()) return;
  const auto rows = static_cast<Eigen::Index>(3 * slots.size());
  Term term{"gnss", pose_columns(network, slots), Eigen::VectorXd(rows), {}, {}};
  const bool delayed = network.shared_mask[kDelay] != 0;
  if (delayed) term.columns.push_back(kDelay);
  term.jacobian.setZero(rows, static_cast<Eigen::Index>(term.columns.size()));
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    const geometry::Pose& pose = state.poses[at(slots[k])];
    const Eigen::Vector3d arm = pose.ground_from_photo * network.problem->lever_arm.in_photo_m;
    term.residual.segment<3>(row) = pose.centre_m + arm -
                                    state.delay_s * velocity_in_enu_m_s(network, slots[k]) -
                                    network.photo(slots[k]).station->antenna_in_enu_m;
    if (delayed) term.jacobian.block<3, 1>(row, 2 * rows) = -velocity_in_enu_m_s(network, slots[k]);
    term.jacobian.block<3, 3>(row, 2 * row).setIdentity();
    term.jacobian.block<3, 3>(row, 2 * row + 3) = -geometry::cross_matrix(arm);
  }
  term.information = station_covariance(network, state, options).inverse();
  terms.push_back(std::move(term));
}

// At zero tilt heading = -kappa. One compass: its error is common, a small share is each photo's.
void add_headings(const Network& network, const State& state, std::vector<Term>& terms) {
  std::vector<int> slots;
  for (int slot = 0; slot < network.slots(); ++slot) {
    if (network.photo(slot).heading) slots.push_back(slot);
  }
  if (slots.empty()) return;
  const auto rows = static_cast<Eigen::Index>(slots.size());
  Term term{"heading", pose_columns(network, slots), Eigen::VectorXd(rows), {}, {}};
  term.jacobian.setZero(rows, Layout::kPose * rows);
  Eigen::VectorXd sigma(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const int slot = slots[static_cast<std::size_t>(k)];
    const HeadingPrior& prior = *network.photo(slot).heading;
    term.residual[k] = wrapped(angles(state, slot).kappa_rad + prior.heading_rad);
    term.jacobian.block<1, 3>(k, Layout::kPose * k + 3) = angles_by_increment(state, slot).row(2);
    sigma[k] = prior.sigma_rad;
  }
  Eigen::MatrixXd covariance = sigma * sigma.transpose();
  covariance += (kOwnHeadingShare * sigma).cwiseAbs2().asDiagonal();
  term.information = covariance.inverse();
  terms.push_back(std::move(term));
}

void add_angle(const Network& network, const State& state, int slot, int angle, double known_rad,
               double sigma_rad, std::vector<Term>& terms) {
  const geometry::OmegaPhiKappa now = angles(state, slot);
  const double computed = std::array{now.omega_rad, now.phi_rad, now.kappa_rad}[at(angle)];
  Term term = scalar_term("attitude", range(network.layout.photo(slot) + 3, 3),
                          wrapped(computed - known_rad), sigma_rad);
  term.jacobian = angles_by_increment(state, slot).row(angle);
  terms.push_back(std::move(term));
}

// The mount keeps the photo near the vertical, as a stabilised gimbal does: in the photo frame the
// ground's zenith R' z lies near +z. Its x and y, for small tilts their angles, do not depend on
// the azimuth; omega and phi do, and would count as knowledge of it. R' exp(-[d]x) z = R' z +
// R' [z]x d.
void add_level(const Network& network, const State& state, int slot, double sigma_rad,
               std::vector<Term>& terms) {
  const Eigen::Matrix3d photo_from_ground = state.poses[at(slot)].ground_from_photo.transpose();
  const Eigen::Vector3d zenith = Eigen::Vector3d::UnitZ();
  Term term{"attitude", range(network.layout.photo(slot) + 3, 3), {}, {}, {}};
  term.residual = (photo_from_ground * zenith).head<2>();
  term.jacobian = (photo_from_ground * geometry::cross_matrix(zenith)).topRows<2>();
  term.information = Eigen::Matrix2d::Identity() / (sigma_rad * sigma_rad);
  terms.push_back(std::move(term));
}

// A stated attitude where there is one; else the mount's.
void add_attitude(const Network& network, const State& state, int slot, const TermOptions& options,
                  std::vector<Term>& terms) {
  const auto& prior = network.photo(slot).attitude;
  if (!prior || !prior->sigma_rad.head<2>().array().isFinite().any()) {
    add_level(network, state, slot, options.tilt_sigma_rad, terms);
  }
  if (!prior) return;
  for (int angle = 0; angle < 3; ++angle) {
    if (!std::isfinite(prior->sigma_rad[angle])) continue;
    if (angle == 2 && options.datum == Datum::kFree) continue;
    add_angle(network, state, slot, angle, prior->omega_phi_kappa_rad[angle],
              prior->sigma_rad[angle], terms);
  }
}

void add_lengths(const Network& network, const State& state, const TermOptions& options,
                 std::vector<Term>& terms) {
  const Layout& layout = network.layout;
  for (int i = 0; i < static_cast<int>(network.problem->lengths.size()); ++i) {
    const Length& length = network.problem->lengths[at(i)];
    const double weight = weight_of(options.length_weights, i);
    if (weight == 0) continue;
    const int a = layout.kept_of_point[at(length.point_a)];
    const int b = layout.kept_of_point[at(length.point_b)];
    if (a < 0 || b < 0) continue;
    const Eigen::Vector3d difference =
        state.points[at(length.point_b)] - state.points[at(length.point_a)];
    std::vector<int> columns = range(layout.kept_point(a), 3);
    for (int axis = 0; axis < 3; ++axis) columns.push_back(layout.kept_point(b) + axis);
    const double metres = std::max(difference.norm(), 1e-9);
    Term term = scalar_term("lengths", std::move(columns), metres - length.metres,
                            std::max(length.sigma_m, kLeastSigmaM) / std::sqrt(weight));
    term.subject = i;
    term.jacobian << -difference.transpose() / metres, difference.transpose() / metres;
    terms.push_back(std::move(term));
  }
}

void add_control(const Network& network, const State& state, const TermOptions& options,
                 std::vector<Term>& terms) {
  for (int i = 0; i < static_cast<int>(network.problem->control.size()); ++i) {
    const Control& control = network.problem->control[at(i)];
    const int kept = network.layout.kept_of_point[at(control.point)];
    const double weight = weight_of(options.control_weights, i);
    if (kept < 0 || weight == 0) continue;
    const Eigen::Matrix3d floor = kLeastSigmaM * kLeastSigmaM * Eigen::Matrix3d::Identity();
    terms.push_back({"control", range(network.layout.kept_point(kept), 3),
                     state.points[at(control.point)] - control.in_enu_m,
                     Eigen::Matrix3d::Identity(),
                     weight * (control.covariance_m2 + floor).inverse(), i});
  }
}

void add_pin(const Network& network, const State& state, const Pin& pin, std::vector<Term>& terms) {
  const Eigen::VectorXd reached = pin_displacement(network, pin.from, state);
  Term term = scalar_term("datum", range(0, network.layout.columns()),
                          pin.gradient.dot(reached) - pin.value, pin.sigma);
  term.jacobian = pin.gradient.transpose();
  for (int slot = 0; slot < network.slots(); ++slot) {
    const int column = network.layout.photo(slot) + 3;
    term.jacobian.middleCols<3>(column) *=
        geometry::rotation_vector_by_increment(reached.segment<3>(column));
  }
  terms.push_back(std::move(term));
}

}  // namespace

Eigen::VectorXd pin_displacement(const Network& network, const State& from, const State& to) {
  const Layout& layout = network.layout;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(layout.columns());
  out.head<kInteriorCount>() = to.interior - from.interior;
  out[kLineTime] = to.line_time_s - from.line_time_s;
  out[kDelay] = to.delay_s - from.delay_s;
  for (int slot = 0; slot < layout.slots; ++slot) {
    const geometry::Pose &a = from.poses[at(slot)], &b = to.poses[at(slot)];
    const Eigen::AngleAxisd turn(b.ground_from_photo * a.ground_from_photo.transpose());
    out.segment<3>(layout.photo(slot)) = b.centre_m - a.centre_m;
    out.segment<3>(layout.photo(slot) + 3) = turn.angle() * turn.axis();
  }
  for (std::size_t k = 0; k < layout.kept.size(); ++k) {
    const std::size_t point = at(layout.kept[k]);
    out.segment<3>(layout.kept_point(static_cast<int>(k))) = to.points[point] - from.points[point];
  }
  return out;
}

double weight_of(const std::vector<double>& weights, int index) {
  return weights.empty() ? 1 : weights[at(index)];
}

geometry::Camera believed_camera(const Network& network, const TermOptions& options) {
  constexpr double kFree = std::numeric_limits<double>::infinity();
  geometry::Camera camera = network.problem->camera;
  for (int i = 0; i < kInteriorCount; ++i) {
    if (!options.interior_freed[at(i)]) continue;
    camera.sigma[i] = kFree;
    if (camera.covariance) (*camera.covariance)(i, i) = kFree;
  }
  return camera;
}

std::vector<int> station_slots(const Network& network, const TermOptions& options) {
  std::vector<int> slots;
  if (options.datum == Datum::kFree) return slots;
  for (int slot = 0; slot < network.slots(); ++slot) {
    if (network.photo(slot).station && weight_of(options.station_weights, slot) > 0)
      slots.push_back(slot);
  }
  return slots;
}

Eigen::MatrixXd station_covariance(const Network& network, const State& state,
                                   const TermOptions& options) {
  const std::vector<int> slots = station_slots(network, options);
  const GnssErrorModel& model = network.problem->gnss;
  const LeverArm& arm = network.problem->lever_arm;
  const Eigen::Vector3d offset(model.offset_sigma_horizontal_m, model.offset_sigma_horizontal_m,
                               model.offset_sigma_vertical_m);
  const Eigen::Vector3d drift(model.correlated_sigma_horizontal_m,
                              model.correlated_sigma_horizontal_m,
                              model.correlated_sigma_vertical_m);
  const auto size = static_cast<Eigen::Index>(3 * slots.size());
  Eigen::MatrixXd covariance(size, size);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = 0; j < slots.size(); ++j) {
      const Photo &a = network.photo(slots[i]), &b = network.photo(slots[j]);
      const double apart_s = std::abs(a.time_s.value_or(0) - b.time_s.value_or(0));
      const double alike = model.correlation_s > 0 ? std::exp(-apart_s / model.correlation_s) : 0;
      Eigen::Matrix3d block =
          (offset.cwiseAbs2() + alike * drift.cwiseAbs2()).asDiagonal().toDenseMatrix();
      block += arm.sigma_m * arm.sigma_m * state.poses[at(slots[i])].ground_from_photo *
               state.poses[at(slots[j])].ground_from_photo.transpose();
      if (i == j) {
        const double weight = weight_of(options.station_weights, slots[i]);
        block +=
            (a.station->covariance_m2 + kLeastSigmaM * kLeastSigmaM * Eigen::Matrix3d::Identity()) /
            weight;
      }
      covariance.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) =
          block;
    }
  }
  return covariance;
}

std::vector<Term> linearised_terms(const Network& network, const State& state, const State& start,
                                   const TermOptions& options) {
  std::vector<Term> terms;
  terms.push_back(camera_term(network, state, options));
  add_line_time(network, state, terms);
  for (int slot = 0; slot < network.slots(); ++slot) {
    add_attitude(network, state, slot, options, terms);
  }
  if (options.datum == Datum::kKnown) {
    add_delay(network, state, terms);
    add_stations(network, state, options, terms);
    add_headings(network, state, terms);
    add_lengths(network, state, options, terms);
    add_control(network, state, options, terms);
  }
  add_datum_terms(network, state, start, options, terms);
  for (const Pin& pin : options.pins) add_pin(network, state, pin, terms);
  return terms;
}

double cost_of(const std::vector<Term>& terms) {
  double cost = 0;
  for (const Term& term : terms) cost += term.residual.dot(term.information * term.residual);
  return cost;
}

}  // namespace plumbline::orient
