// SPDX-License-Identifier: MIT
#include "edge/image/corners.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plumbline::image {
namespace {

// Corners of the half-size photo survive in a photo from farther away.
constexpr std::size_t kCornerLevel = 1;
constexpr int kBlock_px = 7;
// cornerMinEigenVal scales greys to 0..1 and averages: this is a gradient of about one grey level
// per pixel in the weaker direction, below which noise makes the corner.
constexpr float kLeastEigenvalue = 1.5e-5F;

}  // namespace

CellGrid::CellGrid(const Eigen::Vector2d& size_px, int cells_wanted)
    : side_px_(std::max(8.0, std::sqrt(size_px.prod() / std::max(cells_wanted, 1)))),
      across_(std::max(1, static_cast<int>(std::ceil(size_px.x() / side_px_)))),
      down_(std::max(1, static_cast<int>(std::ceil(size_px.y() / side_px_)))) {}

int CellGrid::cell_of(const Eigen::Vector2d& pixel) const {
  const int col = std::clamp(static_cast<int>(pixel.x() / side_px_), 0, across_ - 1);
  const int row = std::clamp(static_cast<int>(pixel.y() / side_px_), 0, down_ - 1);
  return row * across_ + col;
}

std::vector<Eigen::Vector2d> best_corners(const PhotoLevels& photo, const CellGrid& grid,
                                          int margin_px) {
  if (photo.empty()) return {};
  const std::size_t level = std::min(kCornerLevel, photo.level.size() - 1);
  const int grow = 1 << level;
  cv::Mat strength;
  cv::cornerMinEigenVal(photo.level[level], strength, kBlock_px, 3);
  std::vector<float> best(static_cast<std::size_t>(grid.count()), kLeastEigenvalue);
  std::vector<Eigen::Vector2d> place(best.size(), Eigen::Vector2d(-1, -1));
  const int margin = margin_px / grow + 1;
  for (int v = margin; v < strength.rows - margin; ++v) {
    const float* row = strength.ptr<float>(v);
    for (int u = margin; u < strength.cols - margin; ++u) {
      if (row[u] < kLeastEigenvalue) continue;
      const Eigen::Vector2d pixel(u * grow, v * grow);
      const auto cell = static_cast<std::size_t>(grid.cell_of(pixel));
      if (row[u] <= best[cell]) continue;
      best[cell] = row[u];
      place[cell] = pixel;
    }
  }
  std::erase_if(place, [](const Eigen::Vector2d& pixel) { return pixel.x() < 0; });
  return place;
}

}  // namespace plumbline::image
