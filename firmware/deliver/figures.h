// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// A drawing and the words below it; empty where there is nothing to draw.
struct Figure {
  std::string svg;
  std::string caption;  // plain text
};

enum class EllipseKind {
  kAbsolute,  // in the datum of the adjustment
  kLocal      // about the points' own best-fit frame: the shape alone
};

// Points with their error ellipses and the stations, from above.
Figure plan_figure(const Product& product, EllipseKind kind);
// Stations, the ground each has seen, and the heights of the points with their sigmas, from aside.
Figure section_figure(const Product& product);
// Differences in plan at the check points, as arrows (Kunii and Kumazaki 2018, Fig. 9).
Figure check_figure(const Product& product);
// Residual arrows photo by photo.
Figure residual_figure(const Product& product);

}  // namespace plumbline::deliver
