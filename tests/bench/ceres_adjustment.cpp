// SPDX-License-Identifier: MIT
#include "tests/bench/ceres_adjustment.h"

#include <ceres/rotation.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "tests/bench/ceres_analytic.h"
#include "tests/bench/ceres_costs.h"

namespace plumbline::bench {
namespace {

// What the adjustment adds to any known variance; see edge/orient/terms.cpp.
constexpr double kLeastVarianceM2 = 1e-8;
// As minimise(): the last step is the one that lowers the cost by less than this share.
constexpr double kTolerance = 1e-10;

double sigma_of(const Eigen::Matrix3d& isotropic_m2) {
  return std::sqrt(isotropic_m2(0, 0) + kLeastVarianceM2);
}

}  // namespace

struct CeresAdjustment::Photos {
  PhotoFrames frames;
};

CeresAdjustment::CeresAdjustment(const MadeBlock& block, Derivatives derivatives) : block_(block) {
  photos_.resize(block.start.poses.size());
  points_.resize(block.start.points.size());
  restart();
  frames_ = std::make_unique<Photos>(Photos{PhotoFrames(photos_)});
  ceres::Problem::Options options;
  if (derivatives == Derivatives::kAnalytic) options.evaluation_callback = &frames_->frames;
  problem_ = std::make_unique<ceres::Problem>(options);
  add_reprojections(derivatives);
  add_priors();
  order_points_first();
}

CeresAdjustment::~CeresAdjustment() = default;

void CeresAdjustment::restart() {
  const orient::State& start = block_.start;
  for (int i = 0; i < kInterior; ++i) interior_[at(i)] = start.interior[i];
  for (std::size_t i = 0; i < photos_.size(); ++i) {
    const Eigen::Matrix3d photo_from_ground = start.poses[i].ground_from_photo.transpose();
    ceres::RotationMatrixToAngleAxis(photo_from_ground.data(), photos_[i].data());
    Eigen::Map<Eigen::Vector3d>(photos_[i].data() + 3) = start.poses[i].centre_m;
  }
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Eigen::Map<Eigen::Vector3d>(points_[p].data()) = start.points[p];
  }
}

void CeresAdjustment::add_reprojections(Derivatives derivatives) {
  for (const orient::Observation& seen : block_.problem.observations) {
    ceres::CostFunction* cost = nullptr;
    if (derivatives == Derivatives::kAnalytic) {
      cost = new AnalyticReprojection(seen.pixel, seen.sigma_px, frames_->frames[at(seen.photo)]);
    } else {
      cost = new ceres::AutoDiffCostFunction<Reprojection, 2, kInterior, 6, 3>(
          new Reprojection{seen.pixel, seen.sigma_px});
    }
    problem_->AddResidualBlock(cost, nullptr, interior_.data(), photos_[at(seen.photo)].data(),
                               points_[at(seen.point)].data());
  }
}

void CeresAdjustment::add_priors() {
  for (std::size_t i = 0; i < photos_.size(); ++i) {
    const orient::Station& station = block_.problem.photos[i].station.value();
    problem_->AddResidualBlock(new ceres::AutoDiffCostFunction<PhotoPrior, 5, 6>(new PhotoPrior{
                                   station.antenna_in_enu_m, sigma_of(station.covariance_m2),
                                   block_.terms.tilt_sigma_rad}),
                               nullptr, photos_[i].data());
  }
  for (const orient::Control& control : block_.problem.control) {
    problem_->AddResidualBlock(new ceres::AutoDiffCostFunction<ControlPrior, 3, 3>(new ControlPrior{
                                   control.in_enu_m, sigma_of(control.covariance_m2)}),
                               nullptr, points_[at(control.point)].data());
  }
  problem_->AddResidualBlock(new ceres::AutoDiffCostFunction<InteriorPrior, kInterior, kInterior>(
                                 new InteriorPrior{block_.problem.camera}),
                             nullptr, interior_.data());
}

void CeresAdjustment::order_points_first() {
  order_ = std::make_shared<ceres::ParameterBlockOrdering>();
  for (auto& point : points_) order_->AddElementToGroup(point.data(), 0);
  for (auto& photo : photos_) order_->AddElementToGroup(photo.data(), 1);
  order_->AddElementToGroup(interior_.data(), 1);
}

CeresResult CeresAdjustment::solve(ceres::LinearSolverType solver) {
  ceres::Solver::Options options;
  options.linear_solver_type = solver;
  options.preconditioner_type = ceres::SCHUR_JACOBI;
  options.linear_solver_ordering = order_;
  options.num_threads = 1;
  options.max_num_iterations = 100;
  options.function_tolerance = kTolerance;
  options.gradient_tolerance = 1e-30;
  options.parameter_tolerance = 1e-30;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem_.get(), &summary);
  return {summary.termination_type == ceres::CONVERGENCE, 2 * summary.final_cost,
          summary.num_successful_steps + summary.num_unsuccessful_steps};
}

bool CeresAdjustment::covariance_of_points(ceres::CovarianceAlgorithmType algorithm) {
  ceres::Covariance::Options options;
  options.algorithm_type = algorithm;
  options.num_threads = 1;
  covariance_ = std::make_unique<ceres::Covariance>(options);
  std::vector<std::pair<const double*, const double*>> blocks;
  blocks.reserve(points_.size());
  for (const auto& point : points_) blocks.emplace_back(point.data(), point.data());
  return covariance_->Compute(blocks, problem_.get());
}

std::array<double, 9> CeresAdjustment::point_covariance(int point) const {
  std::array<double, 9> out{};
  const double* block = points_[at(point)].data();
  covariance_->GetCovarianceBlock(block, block, out.data());
  return out;
}

}  // namespace plumbline::bench
