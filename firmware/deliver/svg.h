// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumbline::deliver {

// A place in a drawing: x right, y down, in units of its view box.
using Place = Eigen::Vector2d;

// Builds one inline SVG. Looks (colours, line widths, sizes of letters) belong to the page's style
// and are asked for by class names; texts are escaped here.
class Svg {
 public:
  // `label` says to those who cannot see it what is drawn.
  Svg(double width, double height, const std::string& label);

  void line(const Place& from, const Place& to, const std::string& style);
  void polyline(const std::vector<Place>& places, const std::string& style);
  void polygon(const std::vector<Place>& places, const std::string& style);
  void rectangle(const Place& corner, const Place& size, const std::string& style);
  void circle(const Place& centre, double radius, const std::string& style);
  // `turn_deg` clockwise, from the x axis to the first radius.
  void ellipse(const Place& centre, const Eigen::Vector2d& radii, double turn_deg,
               const std::string& style);
  void triangle(const Place& centre, double size, const std::string& style);
  // One path through many dots: a dot of the style's line width at each place.
  void dots(const std::vector<Place>& places, const std::string& style);
  // Arrows as one path, with heads where they are long enough to have one.
  struct Arrow {
    Place from;
    Place to;
  };
  void arrows(const std::vector<Arrow>& arrows, const std::string& style);
  void text(const Place& at, const std::string& words, const std::string& style);

  // What follows, until end_clip(), is cut off at the rectangle. `id` is unique in the page.
  void begin_clip(const std::string& id, const Place& corner, const Place& size);
  void end_clip();

  std::string finish() const;

 private:
  std::string body_;
  std::string head_;
};

// The largest of 1, 2, 5 times a power of ten that is not above `value`.
double nice_below(double value);

}  // namespace plumbline::deliver
