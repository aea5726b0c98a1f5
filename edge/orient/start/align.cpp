// SPDX-License-Identifier: MIT
#include "edge/orient/start/align.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "edge/base/median.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/network/rays.h"
#include "edge/orient/network/stations.h"

namespace plumbline::orient {
namespace {

constexpr int kAzimuthTrials = 72;
constexpr int kReweightings = 5;
constexpr double kCauchySigmas = 3;
// The free network is not yet at its minimum: its stations are good to this share of their height.
constexpr double kCrudeShare = 0.02;

// A place in the free network and where it is known to be.
struct Tie {
  Eigen::Vector3d free = Eigen::Vector3d::Zero();
  Eigen::Vector3d known = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();
};

// known = shift + Rz(azimuth) (scale free + tilt x free); tilt (about east and north of the free
// network) is scaled along with it.
struct Similarity {
  double azimuth_rad = 0;
  double scale = 1;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  // scale times radians
  double cost = std::numeric_limits<double>::infinity();

  Eigen::Matrix3d rotation() const {
    const Eigen::Vector3d small(tilt.x() / scale, tilt.y() / scale, 0);
    return geometry::rotation_by({0, 0, azimuth_rad}) * geometry::rotation_by(small);
  }
  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const {
    return shift + scale * (rotation() * p);
  }
};

Eigen::Vector3d station_sigma(const Network& network, int slot) {
  const GnssErrorModel& m = network.problem->gnss;
  const Eigen::Vector3d drift(m.correlated_sigma_horizontal_m, m.correlated_sigma_horizontal_m,
                              m.correlated_sigma_vertical_m);
  const Eigen::Vector3d white = network.photo(slot).station->covariance_m2.diagonal();
  const Eigen::Vector3d delayed = shift_by_delay_sigma_m(network, slot);
  return (white + drift.cwiseAbs2() + delayed.cwiseAbs2()).cwiseSqrt().cwiseMax(1e-3);
}

std::vector<Tie> ties_of(const Network& network, const State& state, const State& levered,
                         const TermOptions& options) {
  std::vector<Tie> ties;
  for (const int slot : station_slots(network, options)) {
    const Eigen::Vector3d arm =
        levered.poses[at(slot)].ground_from_photo * network.problem->lever_arm.in_photo_m;
    ties.push_back({state.poses[at(slot)].centre_m,
                    network.photo(slot).station->antenna_in_enu_m - arm,
                    station_sigma(network, slot)});
  }
  for (const Control& control : network.problem->control) {
    if (network.layout.kept_of_point[at(control.point)] < 0) continue;
    ties.push_back({state.points[at(control.point)], control.in_enu_m,
                    control.covariance_m2.diagonal().cwiseSqrt().cwiseMax(1e-3)});
  }
  return ties;
}

// The scale that the known lengths ask for; 0 where there is none.
double scale_of_lengths(const Network& network, const State& state) {
  std::vector<double> ratios;
  for (const Length& length : network.problem->lengths) {
    const double free =
        (state.points[at(length.point_b)] - state.points[at(length.point_a)]).norm();
    const bool kept = network.layout.kept_of_point[at(length.point_a)] >= 0 &&
                      network.layout.kept_of_point[at(length.point_b)] >= 0;
    if (kept && free > 0) ratios.push_back(length.metres / free);
  }
  return upper_median(std::move(ratios));
}

// The ratio of the sizes of both sets about their centres: a scale good to its sign.
double scale_of_spread(const std::vector<Tie>& ties) {
  if (ties.size() < 2) return 0;
  Eigen::Vector3d mean_free = Eigen::Vector3d::Zero(), mean_known = mean_free;
  for (const Tie& tie : ties) {
    mean_free += tie.free / static_cast<double>(ties.size());
    mean_known += tie.known / static_cast<double>(ties.size());
  }
  double free = 0, known = 0;
  for (const Tie& tie : ties) {
    free += (tie.free - mean_free).squaredNorm();
    known += (tie.known - mean_known).squaredNorm();
  }
  return free > 0 ? std::sqrt(known / free) : 0;
}

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Guess {
  double scale = 1;
  double scale_sigma = 1;
  double tilt_sigma_rad = 0.03;
};

// Unknowns (shift 3, scale, tilt 2) are linear once the azimuth is given.
Eigen::Matrix<double, 3, 6> design(const Tie& tie, const Eigen::Matrix3d& turn) {
  Eigen::Matrix<double, 3, 6> a;
  a.leftCols<3>().setIdentity();
  a.col(3) = turn * tie.free;
  a.col(4) = turn * Eigen::Vector3d::UnitX().cross(tie.free);
  a.col(5) = turn * Eigen::Vector3d::UnitY().cross(tie.free);
  return a;
}

Similarity fit(const std::vector<Tie>& ties, double azimuth_rad, const Guess& guess) {
  const Eigen::Matrix3d turn = geometry::rotation_by({0, 0, azimuth_rad});
  Similarity result;
  result.azimuth_rad = azimuth_rad;
  std::vector<double> weights(ties.size(), 1.0);
  for (int round = 0; round < kReweightings; ++round) {
    Matrix6 n = Matrix6::Zero();
    Vector6 g = Vector6::Zero();
    n.diagonal().head<3>().setConstant(1e-12);
    n(3, 3) += 1 / (guess.scale_sigma * guess.scale_sigma);
    g[3] += guess.scale * n(3, 3);
    const double tilt_sigma = guess.tilt_sigma_rad * guess.scale;
    n(4, 4) = n(5, 5) = 1 / (tilt_sigma * tilt_sigma);
    for (std::size_t k = 0; k < ties.size(); ++k) {
      const auto a = design(ties[k], turn);
      const Eigen::Matrix<double, 6, 3> aw =
          weights[k] * a.transpose() * ties[k].sigma.cwiseAbs2().cwiseInverse().asDiagonal();
      n += aw * a;
      g += aw * ties[k].known;
    }
    const Vector6 x = n.ldlt().solve(g);
    result.shift = x.head<3>();
    result.scale = x[3];
    result.tilt = x.tail<2>();
    result.cost = result.tilt.squaredNorm() / (tilt_sigma * tilt_sigma) +
                  std::pow((result.scale - guess.scale) / guess.scale_sigma, 2);
    for (std::size_t k = 0; k < ties.size(); ++k) {
      const Eigen::Vector3d miss =
          (design(ties[k], turn) * x - ties[k].known).cwiseQuotient(ties[k].sigma);
      const double c2 = kCauchySigmas * kCauchySigmas;
      result.cost += c2 * std::log1p(miss.squaredNorm() / c2);
      weights[k] = 1 / (1 + miss.squaredNorm() / c2);
    }
  }
  if (!(result.scale > 0)) result.cost = std::numeric_limits<double>::infinity();
  return result;
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

// What compasses and stated attitudes say against an azimuth: one common error, so the mean counts.
double heading_cost(const Network& network, const State& state, double azimuth_rad) {
  double cost = 0;
  double headings = 0;
  for (int slot = 0; slot < network.slots(); ++slot) {
    const double kappa =
        geometry::angles_of(state.poses[at(slot)].ground_from_photo).kappa_rad + azimuth_rad;
    const Photo& photo = network.photo(slot);
    if (photo.heading) {
      cost += std::pow(wrapped(kappa + photo.heading->heading_rad) / photo.heading->sigma_rad, 2);
      ++headings;
    }
  }
  if (headings > 0) cost /= headings;
  for (int slot = 0; slot < network.slots(); ++slot) {
    const auto& attitude = network.photo(slot).attitude;
    if (!attitude || !std::isfinite(attitude->sigma_rad[2])) continue;
    const double kappa =
        geometry::angles_of(state.poses[at(slot)].ground_from_photo).kappa_rad + azimuth_rad;
    cost += std::pow(wrapped(kappa - attitude->omega_phi_kappa_rad[2]) / attitude->sigma_rad[2], 2);
  }
  return cost;
}

Guess guess_of(const Network& network, const State& state, const std::vector<Tie>& ties,
               const TermOptions& options) {
  Guess guess;
  guess.tilt_sigma_rad = options.tilt_sigma_rad;
  if (const double s = scale_of_lengths(network, state); s > 0) {
    guess.scale = s;
    guess.scale_sigma = 0.01 * s;
  } else if (const double spread = scale_of_spread(ties); spread > 0) {
    guess.scale = spread;
    guess.scale_sigma = spread;
  } else {
    guess.scale_sigma = 1e-6;
  }
  return guess;
}

State moved(const State& state, const Similarity& similarity) {
  State out = state;
  const Eigen::Matrix3d rotation = similarity.rotation();
  for (geometry::Pose& pose : out.poses) {
    pose.centre_m = similarity(pose.centre_m);
    pose.ground_from_photo = rotation * pose.ground_from_photo;
  }
  for (Eigen::Vector3d& point : out.points) point = similarity(point);
  return out;
}

double median_height(const State& state) {
  std::vector<double> heights;
  for (const geometry::Pose& pose : state.poses) heights.push_back(std::abs(pose.centre_m.z()));
  return upper_median(std::move(heights));
}

std::vector<double> azimuths_around(int count) {
  std::vector<double> azimuths_rad;
  for (int k = 0; k < count; ++k) azimuths_rad.push_back(2 * std::numbers::pi * k / count);
  return azimuths_rad;
}

// The best of the azimuths given.
State aligned_once(const Network& network, const State& free, const State& levered,
                   const TermOptions& options, const std::vector<double>& azimuths_rad) {
  std::vector<Tie> ties = ties_of(network, free, levered, options);
  const Guess guess = guess_of(network, free, ties, options);
  const double crude_m = kCrudeShare * guess.scale * median_height(free);
  for (Tie& tie : ties) tie.sigma = (tie.sigma.array().square() + crude_m * crude_m).sqrt();
  Similarity best;
  for (const double azimuth_rad : azimuths_rad) {
    Similarity candidate = fit(ties, azimuth_rad, guess);
    candidate.cost += heading_cost(network, free, azimuth_rad);
    if (candidate.cost < best.cost) best = candidate;
  }
  if (!std::isfinite(best.cost)) best.scale = guess.scale;
  return moved(free, best);
}

State aligned_at(const Network& network, const State& free, const TermOptions& options,
                 const std::vector<double>& azimuths_rad) {
  const State roughly = aligned_once(network, free, free, options, azimuths_rad);
  return aligned_once(network, free, roughly, options, azimuths_rad);
}

}  // namespace

State aligned(const Network& network, const State& free, const TermOptions& options) {
  return aligned_at(network, free, options, azimuths_around(kAzimuthTrials));
}

std::vector<State> aligned_all_around(const Network& network, const State& free,
                                      const TermOptions& options, int count) {
  std::vector<State> states;
  for (const double azimuth_rad : azimuths_around(count)) {
    states.push_back(aligned_at(network, free, options, {azimuth_rad}));
  }
  return states;
}

State levelled(const Network& network, const State& aligned, const TermOptions& options) {
  State level = aligned;
  for (int slot = 0; slot < network.slots(); ++slot) {
    geometry::Pose& pose = level.poses[at(slot)];
    geometry::OmegaPhiKappa angles{0, 0, geometry::angles_of(pose.ground_from_photo).kappa_rad};
    if (const auto& attitude = network.photo(slot).attitude) {
      const Eigen::Vector3d& given = attitude->omega_phi_kappa_rad;
      if (std::isfinite(attitude->sigma_rad[0])) angles.omega_rad = given[0];
      if (std::isfinite(attitude->sigma_rad[1])) angles.phi_rad = given[1];
    }
    pose.ground_from_photo = geometry::ground_from_photo(angles);
  }
  for (const int slot : station_slots(network, options)) {
    geometry::Pose& pose = level.poses[at(slot)];
    pose.centre_m = network.photo(slot).station->antenna_in_enu_m -
                    pose.ground_from_photo * network.problem->lever_arm.in_photo_m;
  }
  replant_points(network, level);
  return level;
}

}  // namespace plumbline::orient
