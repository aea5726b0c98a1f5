// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include <array>
#include <memory>
#include <vector>

#include "tests/bench/made_block.h"

namespace plumbline::bench {

enum class Derivatives {
  kAutomatic,  // as users of Ceres write it, after its own bundle adjustment example
  kAnalytic,   // by hand; what is common to the rays of a photo is computed once per evaluation
};

struct CeresResult {
  bool converged = false;
  double cost = 0;  // sum of weighted squared residuals
  int iterations = 0;
};

// The same least squares problem in Ceres: reprojections, stations, control, camera and tilt
// priors; one thread. A photo is six numbers: the angle-axis of photo_from_ground, its centre.
class CeresAdjustment {
 public:
  // `block` must outlive it.
  CeresAdjustment(const MadeBlock& block, Derivatives derivatives);
  ~CeresAdjustment();

  void restart();  // back to the block's start
  CeresResult solve(ceres::LinearSolverType solver);
  // The covariance of all points (3x3 each) at the present values. False where Ceres fails.
  bool covariance_of_points(ceres::CovarianceAlgorithmType algorithm);
  std::array<double, 9> point_covariance(int point) const;

 private:
  struct Photos;
  void add_reprojections(Derivatives derivatives);
  void add_priors();
  void order_points_first();

  const MadeBlock& block_;
  std::array<double, geometry::kInteriorCount> interior_{};
  std::vector<std::array<double, 6>> photos_;
  std::vector<std::array<double, 3>> points_;
  std::unique_ptr<Photos> frames_;
  std::unique_ptr<ceres::Problem> problem_;
  std::shared_ptr<ceres::ParameterBlockOrdering> order_;
  std::unique_ptr<ceres::Covariance> covariance_;
};

}  // namespace plumbline::bench
