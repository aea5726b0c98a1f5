// SPDX-License-Identifier: MIT
#include "edge/image/prediction.h"

#include <algorithm>
#include <array>
#include <limits>

namespace plumbline::image {
namespace {

constexpr std::size_t kNearest = 6;
constexpr double kSoftening_px2 = 40.0 * 40.0;

struct Neighbour {
  double distance2 = std::numeric_limits<double>::infinity();
  std::size_t index = 0;
};

}  // namespace

Predictor::Predictor(const Eigen::Matrix3d& target_from_reference,
                     const std::vector<Correspondence>& matches, double target_width_px)
    : homography_(target_from_reference),
      least_radius_px_(std::max(4.0, 0.002 * target_width_px)),
      most_radius_px_(0.03 * target_width_px) {
  for (const Correspondence& match : matches) {
    place_px_.push_back(match.first_px);
    residual_px_.push_back(match.second_px - transform(homography_, match.first_px));
  }
}

Prediction Predictor::predict(const Eigen::Vector2d& reference_px) const {
  std::array<Neighbour, kNearest> nearest;
  for (std::size_t i = 0; i < place_px_.size(); ++i) {
    const Neighbour candidate{(place_px_[i] - reference_px).squaredNorm(), i};
    if (!(candidate.distance2 < nearest.back().distance2)) continue;
    nearest.back() = candidate;
    for (std::size_t k = kNearest - 1; k > 0 && nearest[k].distance2 < nearest[k - 1].distance2;
         --k) {
      std::swap(nearest[k], nearest[k - 1]);
    }
  }
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double weights = 0;
  for (const Neighbour& one : nearest) {
    if (one.distance2 == std::numeric_limits<double>::infinity()) continue;
    const double weight = 1.0 / (one.distance2 + kSoftening_px2);
    mean += weight * residual_px_[one.index];
    weights += weight;
  }
  if (weights > 0) mean /= weights;
  double spread_px = 0;
  for (const Neighbour& one : nearest) {
    if (one.distance2 == std::numeric_limits<double>::infinity()) continue;
    spread_px = std::max(spread_px, (residual_px_[one.index] - mean).norm());
  }
  Prediction prediction{local_map(homography_, reference_px), 0};
  prediction.map.target_px += mean;
  prediction.radius_px = std::clamp(1.5 * spread_px, least_radius_px_, most_radius_px_);
  return prediction;
}

}  // namespace plumbline::image
