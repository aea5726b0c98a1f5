// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/base/image.h"

namespace plumbline::image {

// A grey photo with its reductions: pixel p of level 0 lies at p / 2^l of level l (8 bits each).
struct PhotoLevels {
  std::vector<cv::Mat> level;

  const cv::Mat& full() const { return level.front(); }
  bool empty() const { return level.empty(); }
  Eigen::Vector2d size_px() const;
};

// Smooths by the binomial 1 4 6 4 1 between levels (Burt and Adelson 1983).
PhotoLevels make_levels(const Image& photo, int levels);

// A smoothed piece of a photo as floats. `values` (0, 0) is pixel `origin` of the photo.
struct Window {
  cv::Mat values;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
};

// The square of half-width `radius_px` about `centre_px`, cut at the photo's edge, smoothed by a
// Gaussian of `sigma_px`. Empty where it would lie wholly outside.
Window smoothed_window(const cv::Mat& photo, const Eigen::Vector2d& centre_px, double radius_px,
                       double sigma_px);

// Grey value and its gradient per pixel.
struct GreySample {
  float value = 0;
  float du = 0;
  float dv = 0;
};

// By cubic convolution (Keys 1981, a = -1/2); nothing within two pixels of the window's edge.
std::optional<GreySample> sample_cubic(const Window& window, const Eigen::Vector2d& pixel);

// What lies between two photos near a point: target ~ target_px + jacobian (x - reference_px).
struct LocalMap {
  Eigen::Vector2d reference_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d target_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
};

// Target pixels per reference pixel.
double scale_of(const Eigen::Matrix2d& jacobian);

// A square of (2 half + 1)^2 values about `centre_px`, neighbours `steps` apart in the photo
// (columns of `steps`: the step of one column, of one row), read bilinearly from the level whose
// pixels match the step. Empty where any of it is outside.
cv::Mat sample_square(const PhotoLevels& photo, const Eigen::Vector2d& centre_px,
                      const Eigen::Matrix2d& steps, int half);

}  // namespace plumbline::image
