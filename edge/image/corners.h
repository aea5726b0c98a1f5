// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/image/patch.h"

namespace plumbline::image {

// A photo divided into cells of equal size for spreading points over it.
class CellGrid {
 public:
  CellGrid(const Eigen::Vector2d& size_px, int cells_wanted);

  int count() const { return across_ * down_; }
  int cell_of(const Eigen::Vector2d& pixel) const;  // the nearest cell for a pixel outside

 private:
  double side_px_;
  int across_;
  int down_;
};

// The best corner (whole pixels; least eigenvalue of the gradient's second moments, Shi and Tomasi
// 1994) of each cell, in order of cells; cells without texture have none. `margin_px` keeps patches
// inside the photo.
std::vector<Eigen::Vector2d> best_corners(const PhotoLevels& photo, const CellGrid& grid,
                                          int margin_px);

}  // namespace plumbline::image
