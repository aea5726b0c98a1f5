// SPDX-License-Identifier: MIT
#include "edge/orient/network/datum_terms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "edge/orient/network/term_parts.h"

namespace plumbline::orient {
namespace {

// Numerically tight, yet far from the limits of double precision beside the image rays.
constexpr double kDatumSigmaM = 1e-5;
constexpr double kDatumSigmaRad = 1e-6;
constexpr double kDatumSigmaScale = 1e-6;
// An azimuth that nobody knows is uniform over the circle.
constexpr double kUniformAzimuthRad = std::numbers::pi / std::numbers::sqrt3;

// Inner constraints on the camera stations: what the network cannot know of itself stays, on the
// whole, where it started.
void add_translation_datum(const Network& network, const State& state, const State& start,
                           std::vector<Term>& terms) {
  const int slots = network.slots();
  Term term{"datum", {}, Eigen::Vector3d::Zero(), {}, {}};
  term.jacobian.setZero(3, 3 * slots);
  for (int slot = 0; slot < slots; ++slot) {
    for (int i = 0; i < 3; ++i) term.columns.push_back(network.layout.photo(slot) + i);
    term.residual += (state.poses[at(slot)].centre_m - start.poses[at(slot)].centre_m) / slots;
    term.jacobian.block<3, 3>(0, 3 * slot) = Eigen::Matrix3d::Identity() / slots;
  }
  term.information = Eigen::Matrix3d::Identity() / (kDatumSigmaM * kDatumSigmaM);
  terms.push_back(std::move(term));
}

void add_azimuth_datum(const Network& network, const State& state, const State& start,
                       double sigma_rad, std::vector<Term>& terms) {
  const int slots = network.slots();
  std::vector<int> columns;
  Eigen::RowVectorXd jacobian(3 * slots);
  double residual = 0;
  for (int slot = 0; slot < slots; ++slot) {
    for (int i = 0; i < 3; ++i) columns.push_back(network.layout.photo(slot) + 3 + i);
    residual += wrapped(angles(state, slot).kappa_rad - angles(start, slot).kappa_rad) / slots;
    jacobian.segment<3>(3 * slot) = angles_by_increment(state, slot).row(2) / slots;
  }
  Term term = scalar_term("datum", std::move(columns), residual, sigma_rad);
  term.jacobian = jacobian;
  terms.push_back(std::move(term));
}

Eigen::Vector3d mean_centre(const State& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const geometry::Pose& pose : state.poses) sum += pose.centre_m;
  return sum / static_cast<double>(state.poses.size());
}

double spread(const State& state) {
  const Eigen::Vector3d mean = mean_centre(state);
  double sum = 0;
  for (const geometry::Pose& pose : state.poses) sum += (pose.centre_m - mean).squaredNorm();
  return std::sqrt(sum);
}

void add_scale_datum(const Network& network, const State& state, const State& start,
                     std::vector<Term>& terms) {
  const double at_start = std::max(spread(start), 1e-9);
  const double now = std::max(spread(state), 1e-9);
  const Eigen::Vector3d mean = mean_centre(state);
  std::vector<int> columns;
  Eigen::RowVectorXd jacobian(3 * network.slots());
  for (int slot = 0; slot < network.slots(); ++slot) {
    for (int i = 0; i < 3; ++i) columns.push_back(network.layout.photo(slot) + i);
    jacobian.segment<3>(3 * slot) =
        (state.poses[at(slot)].centre_m - mean).transpose() / (now * at_start);
  }
  Term term = scalar_term("datum", std::move(columns), now / at_start - 1, kDatumSigmaScale);
  term.jacobian = jacobian;
  terms.push_back(std::move(term));
}

int believed_control(const Network& network, const TermOptions& options) {
  int count = 0;
  for (int i = 0; i < static_cast<int>(network.problem->control.size()); ++i) {
    const int point = network.problem->control[at(i)].point;
    const bool believed = weight_of(options.control_weights, i) > 0;
    count += believed && network.layout.kept_of_point[at(point)] >= 0 ? 1 : 0;
  }
  return count;
}

bool has_kappa(const Network& network) {
  for (int slot = 0; slot < network.slots(); ++slot) {
    const Photo& photo = network.photo(slot);
    if (photo.heading) return true;
    if (photo.attitude && std::isfinite(photo.attitude->sigma_rad[2])) return true;
  }
  return false;
}

bool has_length(const Network& network, const TermOptions& options) {
  for (int i = 0; i < static_cast<int>(network.problem->lengths.size()); ++i) {
    const Length& length = network.problem->lengths[at(i)];
    if (weight_of(options.length_weights, i) > 0 &&
        network.layout.kept_of_point[at(length.point_a)] >= 0 &&
        network.layout.kept_of_point[at(length.point_b)] >= 0)
      return true;
  }
  return false;
}

}  // namespace

DatumDefect datum_defect(const Network& network, const TermOptions& options) {
  if (options.datum == Datum::kFree) return {true, true, true};
  // A station and a control point fix scale and azimuth as two of either do.
  const int places =
      static_cast<int>(station_slots(network, options).size()) + believed_control(network, options);
  return {places == 0, places < 2 && !has_kappa(network),
          places < 2 && !has_length(network, options)};
}

void add_datum_terms(const Network& network, const State& state, const State& start,
                     const TermOptions& options, std::vector<Term>& terms) {
  const DatumDefect defect = datum_defect(network, options);
  if (defect.translation) add_translation_datum(network, state, start, terms);
  add_azimuth_datum(network, state, start, defect.azimuth ? kDatumSigmaRad : kUniformAzimuthRad,
                    terms);
  if (defect.scale) add_scale_datum(network, state, start, terms);
}

}  // namespace plumbline::orient
