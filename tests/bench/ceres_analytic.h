// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "edge/orient/problem.h"

namespace plumbline::bench {

// What the rays of a photo share at one evaluation.
struct PhotoFrame {
  Eigen::Matrix3d photo_from_ground;
  // d (rotation increment in the photo frame) / d angle-axis: exp([J dw]x) R(w) = R(w + dw).
  Eigen::Matrix3d left_jacobian;
};

// Computes the frames of all photos once before each evaluation.
class PhotoFrames final : public ceres::EvaluationCallback {
 public:
  explicit PhotoFrames(const std::vector<std::array<double, 6>>& photos)
      : photos_(photos), frames_(photos.size()) {}

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;
  const PhotoFrame& operator[](std::size_t photo) const { return frames_[photo]; }

 private:
  const std::vector<std::array<double, 6>>& photos_;
  std::vector<PhotoFrame> frames_;
};

// Reprojection of ceres_costs.h with derivatives by hand.
class AnalyticReprojection final
    : public ceres::SizedCostFunction<2, geometry::kInteriorCount, 6, 3> {
 public:
  AnalyticReprojection(const Eigen::Vector2d& measured, double sigma_px, const PhotoFrame& frame)
      : measured_(measured), over_sigma_(1 / sigma_px), frame_(frame) {}

  bool Evaluate(const double* const* parameters, double* residual,
                double** jacobians) const override;

 private:
  Eigen::Vector2d measured_;
  double over_sigma_;
  const PhotoFrame& frame_;
};

}  // namespace plumbline::bench
