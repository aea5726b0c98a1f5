// SPDX-License-Identifier: MIT
#include "tests/edge/orient/made/small_network.h"

#include <Eigen/LU>
#include <numeric>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::orient::testing {
namespace {

FlightPlan small_plan(int targets) {
  FlightPlan plan;
  plan.targets = targets;
  plan.tilt_sigma_deg = 4;
  plan.heading_sigma_deg = 3;
  return plan;
}

void add_known(MadeFlight& flight) {
  Problem& problem = flight.problem;
  problem.lengths.push_back({1, 4, (flight.points[4] - flight.points[1]).norm() + 0.01, 0.002});
  Eigen::Matrix3d covariance;
  covariance << 4e-4, 1e-4, 0, 1e-4, 5e-4, -1e-4, 0, -1e-4, 9e-4;
  problem.control.push_back({6, flight.points[6] + Eigen::Vector3d(0.02, -0.01, 0.03), covariance});
  problem.lever_arm = {{0.1, 0.2, -0.3}, 0.01};
  problem.gnss = {0.02, 0.03, 30, 0.01, 0.02};
  for (std::size_t i = 0; i < problem.photos.size(); ++i) {
    problem.photos[i].time_s = 8.0 * static_cast<double>(i);
    problem.photos[i].velocity_in_enu_m_s = Eigen::Vector3d(0.5, -0.2, 1.5);
  }
  problem.camera.line_time_us = 20;
  problem.camera.line_time_sigma_us = 8;
  problem.photos[2].attitude = AttitudePrior{{0.03, -0.05, 1.0}, {0.02, 0.03, 0.1}};
}

}  // namespace

SmallNetwork::SmallNetwork(std::uint64_t seed, int targets) {
  MadeFlight flight = make_flight(small_plan(targets), seed);
  add_known(flight);
  problem = std::move(flight.problem);
  std::vector<int> photos(problem.photos.size());
  std::iota(photos.begin(), photos.end(), 0);
  network = make_network(problem, photos);
  datum = {flight.interior, flight.poses, flight.points, 20e-6};
  state = datum;
  std::mt19937_64 random(seed + 1);
  std::normal_distribution<double> normal(0, 1);
  const auto vector = [&](double sigma) {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Eigen::Vector3d(sigma * Eigen::Vector3d(x, y, z));
  };
  for (geometry::Pose& pose : state.poses) {
    pose.centre_m += vector(0.05);
    pose.ground_from_photo = geometry::rotation_by(vector(2e-3)) * pose.ground_from_photo;
  }
  for (Eigen::Vector3d& point : state.points) point += vector(0.05);
  state.interior[0] += 3;
  state.line_time_s = 22e-6;
  options.tilt_sigma_rad = 2 * kRadPerDeg;
}

DenseSystem::DenseSystem(const Network& network, const std::vector<RayLinear>& rays,
                         const std::vector<Term>& terms)
    : network_(network) {
  int columns = network.layout.columns();
  for (int p = 0; p < network.points(); ++p) {
    const int kept = network.layout.kept_of_point[at(p)];
    point_column_.push_back(kept >= 0 ? network.layout.kept_point(kept) : columns);
    if (kept < 0) columns += 3;
  }
  normal_.setZero(columns, columns);
  gradient_.setZero(columns);
  for (const Term& term : terms) add(term.columns, term.jacobian, term.information, term.residual);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!rays[k].active) continue;
    std::vector<int> of_ray(kRayColumns + 3);
    std::iota(of_ray.begin(), of_ray.begin() + kShared, 0);
    std::iota(of_ray.begin() + kShared, of_ray.begin() + kRayColumns,
              network.layout.photo(network.rays[k].slot));
    std::iota(of_ray.begin() + kRayColumns, of_ray.end(), column_of_point(network.rays[k].point));
    Eigen::MatrixXd jacobian(2, kRayColumns + 3);
    jacobian << rays[k].by_common, rays[k].by_point;
    add(of_ray, jacobian, rays[k].information * Eigen::Matrix2d::Identity(), rays[k].residual);
  }
}

void DenseSystem::add(const std::vector<int>& columns, const Eigen::MatrixXd& jacobian,
                      const Eigen::MatrixXd& information, const Eigen::VectorXd& residual) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(jacobian.rows(), normal_.cols());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    a.col(columns[i]) += jacobian.col(static_cast<Eigen::Index>(i));
  }
  normal_ += a.transpose() * information * a;
  gradient_ += a.transpose() * information * residual;
}

std::vector<int> DenseSystem::adjusted() const {
  std::vector<int> columns;
  for (int c = 0; c < static_cast<int>(normal_.cols()); ++c) {
    if (c >= kShared || network_.shared_mask[c] != 0) columns.push_back(c);
  }
  return columns;
}

Eigen::MatrixXd DenseSystem::covariance() const {
  const std::vector<int> free = adjusted();
  // Scaled to a unit diagonal: the unknowns' units differ by many powers of ten.
  const Eigen::MatrixXd part = normal_(free, free);
  const Eigen::VectorXd scale = part.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * part * scale.asDiagonal();
  const Eigen::MatrixXd inverse = scaled.fullPivLu().inverse();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(normal_.rows(), normal_.cols());
  out(free, free) = scale.asDiagonal() * inverse * scale.asDiagonal();
  return out;
}

Step DenseSystem::step() const {
  const Eigen::VectorXd x = -covariance() * gradient_;
  Step step{x.head(network_.layout.columns()), {}};
  for (int p = 0; p < network_.points(); ++p) {
    const bool kept = network_.layout.kept_of_point[at(p)] >= 0;
    step.points.push_back(kept ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                               : Eigen::Vector3d(x.segment<3>(column_of_point(p))));
  }
  return step;
}

State nudged(const Network& network, const State& state, int column, double by) {
  Step step{Eigen::VectorXd::Zero(network.layout.columns()),
            std::vector<Eigen::Vector3d>(state.points.size(), Eigen::Vector3d::Zero())};
  step.common[column] = by;
  return moved_by(network, state, step);
}

}  // namespace plumbline::orient::testing
