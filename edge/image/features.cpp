// SPDX-License-Identifier: MIT
#include "edge/image/features.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/features2d.hpp>

namespace plumbline::image {
namespace {

constexpr double kFewestPixels = 5e5;  // of the level that is searched
constexpr int kCellsAcross = 8;
constexpr float kRatio = 0.85F;  // of distances: Lowe 2004, section 7.1

std::size_t screening_level(const PhotoLevels& photo) {
  std::size_t level = 0;
  while (level + 1 < photo.level.size() &&
         static_cast<double>(photo.level[level + 1].total()) >= kFewestPixels) {
    ++level;
  }
  return level;
}

bool stronger(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  if (a.response != b.response) return a.response > b.response;
  if (a.pt.y != b.pt.y) return a.pt.y < b.pt.y;
  if (a.pt.x != b.pt.x) return a.pt.x < b.pt.x;
  return a.angle < b.angle;
}

// The strongest of each cell in turn, so that one rich corner does not take all places.
std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> points, const cv::Size& size,
                                 int wanted) {
  std::sort(points.begin(), points.end(), stronger);
  std::vector<std::vector<cv::KeyPoint>> cells(kCellsAcross * kCellsAcross);
  for (const cv::KeyPoint& point : points) {
    const int col = std::clamp(static_cast<int>(point.pt.x) * kCellsAcross / size.width, 0, 7);
    const int row = std::clamp(static_cast<int>(point.pt.y) * kCellsAcross / size.height, 0, 7);
    cells[static_cast<std::size_t>(row * kCellsAcross + col)].push_back(point);
  }
  std::vector<cv::KeyPoint> chosen;
  for (std::size_t rank = 0; static_cast<int>(chosen.size()) < wanted; ++rank) {
    const std::size_t before = chosen.size();
    for (const auto& cell : cells) {
      if (rank < cell.size() && static_cast<int>(chosen.size()) < wanted)
        chosen.push_back(cell[rank]);
    }
    if (chosen.size() == before) break;
  }
  return chosen;
}

Eigen::MatrixXf unit_columns(const cv::Mat& descriptors) {
  Eigen::MatrixXf columns(descriptors.cols, descriptors.rows);
  for (int i = 0; i < descriptors.rows; ++i) {
    for (int k = 0; k < descriptors.cols; ++k) columns(k, i) = descriptors.at<float>(i, k);
    const float norm = columns.col(i).norm();
    if (norm > 0) columns.col(i) /= norm;
  }
  return columns;
}

struct Best {
  int index = -1;
  float first = -1;
  float second = -1;
  void offer(int candidate, float score) {
    if (score > first) {
      second = first;
      first = score;
      index = candidate;
    } else if (score > second) {
      second = score;
    }
  }
  // Distances of unit vectors: d^2 = 2 - 2 cos.
  bool clear() const { return 1 - first < kRatio * kRatio * (1 - second); }
};

}  // namespace

Features detect_features(const PhotoLevels& photo, int wanted) {
  Features features;
  if (photo.empty()) return features;
  const std::size_t level = screening_level(photo);
  const cv::Mat& image = photo.level[level];
  const auto sift = cv::SIFT::create(0, 3, 0.02);
  std::vector<cv::KeyPoint> points;
  sift->detect(image, points);
  points = spread(std::move(points), image.size(), wanted);
  if (points.empty()) return features;
  cv::Mat descriptors;
  sift->compute(image, points, descriptors);
  const double grow = static_cast<double>(1 << level);
  for (const cv::KeyPoint& point : points)
    features.place_px.emplace_back(grow * point.pt.x, grow * point.pt.y);
  features.descriptors = unit_columns(descriptors);
  return features;
}

std::vector<std::pair<int, int>> match_features(const Features& first, const Features& second) {
  std::vector<std::pair<int, int>> matches;
  if (first.place_px.empty() || second.place_px.empty()) return matches;
  const Eigen::MatrixXf scores = second.descriptors.transpose() * first.descriptors;
  std::vector<Best> of_first(first.place_px.size());
  std::vector<Best> of_second(second.place_px.size());
  for (Eigen::Index i = 0; i < scores.cols(); ++i) {
    for (Eigen::Index j = 0; j < scores.rows(); ++j) {
      of_first[static_cast<std::size_t>(i)].offer(static_cast<int>(j), scores(j, i));
      of_second[static_cast<std::size_t>(j)].offer(static_cast<int>(i), scores(j, i));
    }
  }
  for (std::size_t i = 0; i < of_first.size(); ++i) {
    const Best& best = of_first[i];
    if (best.index < 0 || !best.clear()) continue;
    const Best& back = of_second[static_cast<std::size_t>(best.index)];
    if (back.index == static_cast<int>(i)) matches.emplace_back(static_cast<int>(i), best.index);
  }
  return matches;
}

}  // namespace plumbline::image
