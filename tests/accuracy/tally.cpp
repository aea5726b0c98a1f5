// SPDX-License-Identifier: MIT
#include "tests/accuracy/tally.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "edge/base/index.h"
#include "edge/base/parallel.h"
#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::accuracy {
namespace {

using orient::testing::FlightPlan;
using orient::testing::MadeFlight;

// Shift, turn and scale of the whole, to first order: 3n x 7.
Eigen::MatrixXd similarity_design(const MadeFlight& flight, const std::vector<int>& points) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int p : points) centre += flight.points[at(p)] / static_cast<double>(points.size());
  Eigen::MatrixXd g(static_cast<Eigen::Index>(3 * points.size()), 7);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector3d arm = flight.points[at(points[k])] - centre;
    g.middleRows<3>(static_cast<Eigen::Index>(3 * k)) << Eigen::Matrix3d::Identity(),
        -geometry::cross_matrix(arm), arm;
  }
  return g;
}

// The errors of one flight, in the order of `points`.
struct Errors {
  std::vector<int> points;
  Eigen::VectorXd absolute_m, local_m;
  // What the whole is turned and scaled by followed as a turn, as if along its tangent: of which
  // the azimuth is read.
  Eigen::VectorXd along_tangent_m;
  Eigen::MatrixXd stated, bound;
};

Eigen::Matrix3Xd truth_of(const MadeFlight& flight, const std::vector<int>& points) {
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < out.cols(); ++k)
    out.col(k) = flight.points[at(points[static_cast<std::size_t>(k)])];
  return out;
}

Eigen::Matrix3Xd measured_of(const orient::Solution& solution, const std::vector<int>& points) {
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < out.cols(); ++k)
    out.col(k) = solution.points[at(points[static_cast<std::size_t>(k)])].in_enu_m;
  return out;
}

void fill_errors(const Eigen::Matrix3Xd& truth, const Eigen::Matrix3Xd& measured, Errors& out) {
  out.absolute_m = (measured - truth).reshaped();
  const Eigen::Matrix4d fit = Eigen::umeyama(truth, measured, true);
  const Eigen::Matrix3Xd fitted =
      (fit.topLeftCorner<3, 3>() * truth).colwise() + fit.topRightCorner<3, 1>();
  const double scale = std::cbrt(fit.topLeftCorner<3, 3>().determinant());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(fit.topLeftCorner<3, 3>() / scale));
  const Eigen::Vector3d centre = fitted.rowwise().mean();
  const Eigen::Matrix3Xd arms = fitted.colwise() - centre;
  Eigen::Matrix3Xd shared = std::log(scale) * arms;
  for (Eigen::Index k = 0; k < arms.cols(); ++k)
    shared.col(k) += turn.angle() * turn.axis().cross(arms.col(k));
  shared.colwise() += centre - truth.rowwise().mean();
  out.local_m = (measured - fitted).reshaped();
  out.along_tangent_m = (shared + (measured - fitted)).reshaped();
}

Eigen::MatrixXd blocks_of(const Eigen::MatrixXd& whole, const std::vector<int>& points) {
  std::vector<int> rows;
  for (const int p : points) {
    for (int i = 0; i < 3; ++i) rows.push_back(3 * p + i);
  }
  return whole(rows, rows);
}

Errors errors_of(const MadeFlight& flight, const orient::Solution& solution, const Bound& bound) {
  Errors out;
  for (int p = 0; p < flight.targets; ++p) {
    if (solution.points[at(p)].measured && bound.defined[at(p)]) out.points.push_back(p);
  }
  fill_errors(truth_of(flight, out.points), measured_of(solution, out.points), out);
  out.stated = solution.covariances->joint(out.points);
  out.bound = blocks_of(bound.targets, out.points);
  return out;
}

void compare_with_bound(const MadeFlight& flight, const Errors& e, Tally& tally) {
  const Eigen::MatrixXd g = similarity_design(flight, e.points);
  const Eigen::MatrixXd shared = g * (g.transpose() * g).ldlt().solve(g.transpose());
  const Eigen::MatrixXd own = Eigen::MatrixXd::Identity(shared.rows(), shared.cols()) - shared;
  const Eigen::MatrixXd local_bound = own * e.bound * own.transpose();
  double mean_height = 0;
  for (const int p : e.points)
    mean_height += flight.points[at(p)].z() / static_cast<double>(e.points.size());
  for (std::size_t k = 0; k < e.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    tally.absolute.squares += e.absolute_m.segment<3>(row).cwiseAbs2();
    tally.absolute.bound += e.bound.diagonal().segment<3>(row);
    tally.local.squares += e.local_m.segment<3>(row).cwiseAbs2();
    tally.local.bound += local_bound.diagonal().segment<3>(row);
    ++tally.absolute.points;
    ++tally.local.points;
    tally.flat_squares += std::pow(flight.points[at(e.points[k])].z() - mean_height, 2);
  }
}

void compare_with_stated(const MadeFlight& flight, const orient::Solution& solution,
                         const Errors& e, Tally& tally) {
  for (Eigen::Index i = 0; i < e.absolute_m.size(); ++i) {
    tally.points.add(e.absolute_m[i], e.stated(i, i));
    const int p = e.points[static_cast<std::size_t>(i / 3)];
    tally.local_points.add(e.local_m[i], solution.points[at(p)].local_covariance_m2(i % 3, i % 3));
  }
  tally.nees += e.absolute_m.dot(e.stated.ldlt().solve(e.absolute_m));
  tally.nees_dof += static_cast<int>(e.absolute_m.size());
  const Eigen::MatrixXd g = similarity_design(flight, e.points);
  const Eigen::MatrixXd to_shared = (g.transpose() * g).ldlt().solve(g.transpose());
  const Eigen::VectorXd shared = to_shared * e.along_tangent_m;
  constexpr int kAzimuth = 5;
  tally.azimuth.add(shared[kAzimuth],
                    (to_shared * e.stated * to_shared.transpose())(kAzimuth, kAzimuth));
  const double f_error = solution.camera.interior[0] - flight.interior[0];
  tally.focal_length.add(f_error, solution.camera.sigma[0] * solution.camera.sigma[0]);
}

void compare_poses(const MadeFlight& flight, const orient::Solution& solution, Tally& tally) {
  for (std::size_t i = 0; i < flight.poses.size(); ++i) {
    const orient::OrientedPhoto& photo = solution.photos[i];
    if (!photo.oriented) continue;
    const Eigen::Vector3d centre = photo.pose.centre_m - flight.poses[i].centre_m;
    const Eigen::AngleAxisd turn(photo.pose.ground_from_photo *
                                 flight.poses[i].ground_from_photo.transpose());
    const Eigen::Vector3d rotation = turn.angle() * turn.axis();
    for (int k = 0; k < 3; ++k) {
      tally.poses.add(centre[k], photo.covariance(k, k));
      tally.poses.add(rotation[k], photo.covariance(k + 3, k + 3));
    }
  }
}

void count_observations(const MadeFlight& flight, const orient::Solution& solution, Tally& tally) {
  for (std::size_t k = 0; k < solution.residuals.size(); ++k) {
    if (!solution.residuals[k].used) continue;
    ++tally.accepted;
    tally.accepted_gross += flight.gross[k] ? 1 : 0;
  }
  for (const orient::Unobservable& u : solution.summary.unobservable) {
    tally.azimuth_declared += u.name == "azimuth" ? 1 : 0;
  }
}

}  // namespace

void Shares::add(double error, double variance) {
  ++count;
  within_one += error * error < variance ? 1 : 0;
  within_two += error * error < 4 * variance ? 1 : 0;
}

void Shares::operator+=(const Shares& other) {
  count += other.count;
  within_one += other.within_one;
  within_two += other.within_two;
}

void AgainstBound::operator+=(const AgainstBound& other) {
  squares += other.squares;
  bound += other.bound;
  points += other.points;
}

void Tally::operator+=(const Tally& other) {
  trials += other.trials;
  failed += other.failed;
  unconverged += other.unconverged;
  absolute += other.absolute;
  local += other.local;
  flat_squares += other.flat_squares;
  points += other.points;
  poses += other.poses;
  local_points += other.local_points;
  focal_length += other.focal_length;
  azimuth += other.azimuth;
  nees += other.nees;
  nees_dof += other.nees_dof;
  targets_given += other.targets_given;
  targets_measured += other.targets_measured;
  accepted += other.accepted;
  accepted_gross += other.accepted_gross;
  azimuth_declared += other.azimuth_declared;
}

Tally fly(const FlightPlan& plan, std::uint64_t seed, const orient::Options& options) {
  const MadeFlight flight = orient::testing::make_flight(plan, seed);
  Tally tally;
  tally.trials = 1;
  const auto solution = orient::adjust(flight.problem, options);
  const auto bound = bound_of(flight, options.tilt_sigma_deg * kRadPerDeg);
  if (!solution || !bound) {
    tally.failed = 1;
    return tally;
  }
  tally.unconverged = solution->summary.converged ? 0 : 1;
  const Errors errors = errors_of(flight, *solution, *bound);
  for (const bool defined : bound->defined) tally.targets_given += defined ? 1 : 0;
  tally.targets_measured = static_cast<int>(errors.points.size());
  count_observations(flight, *solution, tally);
  if (errors.points.size() < 3) return tally;
  compare_with_bound(flight, errors, tally);
  compare_with_stated(flight, *solution, errors, tally);
  compare_poses(flight, *solution, tally);
  return tally;
}

Tally fly_many(const FlightPlan& plan, int trials, std::uint64_t first_seed,
               const orient::Options& options, int threads) {
  std::vector<Tally> tallies(at(trials));
  parallel_for(trials, threads, [&](int i) {
    tallies[at(i)] = fly(plan, first_seed + static_cast<std::uint64_t>(i), options);
  });
  Tally sum;
  for (const Tally& tally : tallies) sum += tally;
  return sum;
}

}  // namespace plumbline::accuracy
