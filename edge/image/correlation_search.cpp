// SPDX-License-Identifier: MIT
#include "edge/image/correlation_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plumbline::image {
namespace {

constexpr int kMostSteps = 10;

struct Peak {
  cv::Point place;
  double best = -1;
  double second = -1;  // the highest score more than two steps away
};

Peak highest(const cv::Mat& scores) {
  Peak peak;
  cv::minMaxLoc(scores, nullptr, &peak.best, nullptr, &peak.place);
  for (int row = 0; row < scores.rows; ++row) {
    for (int col = 0; col < scores.cols; ++col) {
      const bool near = std::abs(row - peak.place.y) <= 2 && std::abs(col - peak.place.x) <= 2;
      if (!near) peak.second = std::max<double>(peak.second, scores.at<float>(row, col));
    }
  }
  return peak;
}

// The top of the parabola through three scores, in steps from the middle one.
double vertex(double before, double middle, double after) {
  const double bend = before - 2 * middle + after;
  return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

Eigen::Vector2d refine(const cv::Mat& scores, const cv::Point& place) {
  const auto at = [&](int dx, int dy) {
    const int x = std::clamp(place.x + dx, 0, scores.cols - 1);
    const int y = std::clamp(place.y + dy, 0, scores.rows - 1);
    return static_cast<double>(scores.at<float>(y, x));
  };
  return {place.x + vertex(at(-1, 0), at(0, 0), at(1, 0)),
          place.y + vertex(at(0, -1), at(0, 0), at(0, 1))};
}

struct Step {
  double spacing_px = 1;  // in the reference
  int radius = 2;         // of the search, in steps
  bool must_be_alone = false;
};

bool search_once(const PhotoLevels& reference, const PhotoLevels& target, const Step& step,
                 const SearchOptions& options, LocalMap& map) {
  const Eigen::Matrix2d square = step.spacing_px * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d steps = map.jacobian * step.spacing_px;
  const cv::Mat patch = sample_square(reference, map.reference_px, square, options.half_size);
  const cv::Mat field =
      sample_square(target, map.target_px, steps, options.half_size + step.radius);
  if (patch.empty() || field.empty()) return false;
  cv::Mat scores;
  cv::matchTemplate(field, patch, scores, cv::TM_CCOEFF_NORMED);
  const Peak peak = highest(scores);
  if (!(peak.best >= options.least_correlation)) return false;
  if (step.must_be_alone && peak.second > options.most_second * peak.best) return false;
  map.target_px += steps * (refine(scores, peak.place) - Eigen::Vector2d(step.radius, step.radius));
  return true;
}

}  // namespace

std::optional<LocalMap> search_by_correlation(const PhotoLevels& reference,
                                              const PhotoLevels& target, const LocalMap& guess,
                                              double radius_px, const SearchOptions& options) {
  const double scale = scale_of(guess.jacobian);
  if (!(scale > 0.1 && scale < 10)) return std::nullopt;
  const double finest_px = std::max(1.0, 1.0 / scale);
  const double radius_in_reference_px = radius_px / scale;
  double spacing_px = finest_px;
  while (radius_in_reference_px > kMostSteps * spacing_px) spacing_px *= 2;
  LocalMap map = guess;
  Step step{spacing_px, static_cast<int>(std::ceil(radius_in_reference_px / spacing_px)), true};
  step.radius = std::max(step.radius, 3);
  for (; step.spacing_px >= finest_px * 0.99; step.spacing_px /= 2) {
    if (!search_once(reference, target, step, options, map)) return std::nullopt;
    step.radius = 3;
    step.must_be_alone = false;
  }
  return map;
}

}  // namespace plumbline::image
