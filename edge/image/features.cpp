// SPDX-License-Identifier: MIT
#include "edge/image/features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

// SIFT's scale space takes some 230 bytes a pixel (twice as wide and high, 11 images of floats for
// each octave), and each thread has its own: of a tile at a time. A margin holds what OpenCV's
// descriptors of sigmas up to 6 pixels look at (3 sqrt(2) (4 + 1) / 2 sigmas); larger features are
// few.
constexpr int kTile_px = 800;
constexpr int kMargin_px = 64;

struct Tile {
  cv::Rect core;   // features of which it has
  cv::Rect whole;  // with its margin, within the image
  cv::Mat image;
  bool has(const cv::KeyPoint& point) const {
    return core.contains(cv::Point(static_cast<int>(point.pt.x), static_cast<int>(point.pt.y)));
  }
};

std::vector<Tile> tiles_of(const cv::Mat& image) {
  const auto parts = [](int side) { return (side + kTile_px - 1) / kTile_px; };
  const cv::Rect all(0, 0, image.cols, image.rows);
  std::vector<Tile> tiles;
  for (int row = 0; row < parts(image.rows); ++row) {
    for (int col = 0; col < parts(image.cols); ++col) {
      const cv::Point begin(image.cols * col / parts(image.cols),
                            image.rows * row / parts(image.rows));
      const cv::Point end(image.cols * (col + 1) / parts(image.cols),
                          image.rows * (row + 1) / parts(image.rows));
      const cv::Point margin(kMargin_px, kMargin_px);
      const cv::Rect whole = cv::Rect(begin - margin, end + margin) & all;
      tiles.push_back({cv::Rect(begin, end), whole, image(whole)});
    }
  }
  return tiles;
}

std::vector<cv::KeyPoint> moved(std::vector<cv::KeyPoint> points, const cv::Point& by) {
  for (cv::KeyPoint& point : points) point.pt += cv::Point2f(by);
  return points;
}

std::vector<cv::KeyPoint> detect_in(const std::vector<Tile>& tiles, cv::SIFT& sift) {
  std::vector<cv::KeyPoint> all;
  for (const Tile& tile : tiles) {
    std::vector<cv::KeyPoint> points;
    sift.detect(tile.image, points);
    for (const cv::KeyPoint& point : moved(std::move(points), tile.whole.tl())) {
      if (tile.has(point)) all.push_back(point);
    }
  }
  return all;
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

// Of `points`, tile by tile.
Features described(const std::vector<cv::KeyPoint>& points, const std::vector<Tile>& tiles,
                   cv::SIFT& sift) {
  Features features;
  cv::Mat descriptors;
  for (const Tile& tile : tiles) {
    std::vector<cv::KeyPoint> own;
    std::copy_if(points.begin(), points.end(), std::back_inserter(own),
                 [&](const cv::KeyPoint& point) { return tile.has(point); });
    own = moved(std::move(own), -tile.whole.tl());
    if (own.empty()) continue;
    cv::Mat of_tile;
    sift.compute(tile.image, own, of_tile);
    descriptors.push_back(of_tile);
    for (const cv::KeyPoint& point : moved(std::move(own), tile.whole.tl()))
      features.place_px.emplace_back(point.pt.x, point.pt.y);
  }
  features.descriptors = unit_columns(descriptors);
  return features;
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
  const std::vector<Tile> tiles = tiles_of(image);
  const auto sift = cv::SIFT::create(0, 3, 0.02);
  const auto points = spread(detect_in(tiles, *sift), image.size(), wanted);
  features = described(points, tiles, *sift);
  const double grow = static_cast<double>(1 << level);
  for (Eigen::Vector2d& place : features.place_px) place *= grow;
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
