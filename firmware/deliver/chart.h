// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "firmware/deliver/svg.h"

namespace plumbline::deliver {

// A drawing of metres to scale, the same in both directions, with a grid that bears coordinates.
// Ground (x right, y up, metres) to view box (y down).
class Chart {
 public:
  // All of [low, high] (metres) is shown; the plot is `width` units wide and at most `max_height`
  // high, and what is left over on either side is filled with more ground.
  Chart(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m, double width,
        double max_height);

  Place at(const Eigen::Vector2d& ground_m) const;
  double units_per_metre() const { return units_per_metre_; }
  double full_width() const;
  double full_height() const;  // plot, axis labels and the strip below
  double strip_top() const;    // of the strip for scale bars and legend
  Place corner() const { return corner_; }
  Place size() const { return size_; }
  bool shows(const Eigen::Vector2d& ground_m) const;

  void draw_grid(Svg& svg, const std::string& x_name, const std::string& y_name) const;
  // A bar of a round length of ground at the left of the strip.
  void draw_scale_bar(Svg& svg) const;

 private:
  Eigen::Vector2d low_m_;
  Eigen::Vector2d high_m_;
  Place corner_;
  Place size_;
  double units_per_metre_;
};

// Smallest box around the places, without the outermost share on each side; padded.
struct Box {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
};
Box box_around(const std::vector<Eigen::Vector2d>& places, double outer_share);
Box joined(const Box& a, const Box& b);
Box padded(const Box& box, double share);

// A round factor by which to exaggerate lengths (metres) so that the median is drawn `median_units`
// long and none beyond `largest_units`.
double exaggeration(const std::vector<double>& lengths_m, double units_per_metre,
                    double median_units, double largest_units);

// "x 200", or "reduced to 0.1" for factors below one.
std::string exaggeration_words(double factor);

}  // namespace plumbline::deliver
