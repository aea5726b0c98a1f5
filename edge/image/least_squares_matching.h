// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "edge/image/patch.h"

namespace plumbline::image {

struct MatchOptions {
  int half_size = 9;                // of the patch, in pixels of the coarser photo
  double least_correlation = 0.80;  // of the two patches after the match
  double most_shift = 4.0;          // from the guess, in pixels of the coarser photo
  double most_sigma = 0.30;         // of the match, in pixels of the coarser photo
};

// A point of the reference photo found in the target photo.
struct PatchMatch {
  LocalMap map;
  // The error of the match comes from the noise of both patches: this is each photo's share, in
  // its own pixels. The template's share is the same error in every photo matched with it.
  Eigen::Matrix2d target_covariance_px2 = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d reference_covariance_px2 = Eigen::Matrix2d::Identity();
  double correlation = 0;
};

// Least-squares matching with an affine map and a linear change of brightness (Gruen 1985,
// Adaptive least squares correlation). Samples are one pixel of the coarser photo apart; the finer
// photo is smoothed to the coarser one's resolution before it is sampled. Nothing where it does
// not converge, leaves a photo, or does not meet the options.
std::optional<PatchMatch> match_patch(const cv::Mat& reference, const cv::Mat& target,
                                      const LocalMap& guess, const MatchOptions& options);

}  // namespace plumbline::image
