// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include "firmware/deliver/chart.h"
#include "firmware/deliver/figures.h"
#include "firmware/deliver/labels.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

constexpr std::size_t kMostCheckArrows = 400;
// As in Fig. 9 of Kunii and Kumazaki 2018; another factor only where nothing could be seen or the
// arrows would leave the picture.
constexpr double kUsualFactor = 10;
constexpr double kShortestMedian = 4;
constexpr double kLongest = 220;

struct Shown {
  std::vector<std::string> names;
  std::vector<Eigen::Vector2d> known_m;
  std::vector<Eigen::Vector2d> difference_m;
};

Shown shown_of(const Product& product) {
  Shown shown;
  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < product.problem.point_names.size(); ++i)
    index_of[product.problem.point_names[i]] = i;
  for (const survey::CheckedPoint& point : product.check->points) {
    const auto found = index_of.find(point.point);
    if (found == index_of.end() || shown.names.size() == kMostCheckArrows) continue;
    shown.names.push_back(point.point);
    shown.difference_m.emplace_back(point.difference_m.head<2>());
    shown.known_m.emplace_back(product.solution.points[found->second].in_enu_m.head<2>() -
                               point.difference_m.head<2>());
  }
  return shown;
}

Chart chart_of(const Shown& shown) {
  const Box box = padded(box_around(shown.known_m, 0.0), 0.1);
  return Chart(box.low, box.high, 880, 700);
}

// Differences in plan at the check points, as arrows from where the points are known to be.
class CheckArrows {
 public:
  explicit CheckArrows(const Product& product)
      : product_(product), shown_(shown_of(product)), chart_(chart_of(shown_)) {
    choose_factor();
  }

  Figure draw() {
    Svg svg(chart_.full_width(), chart_.full_height(), "Differences in plan at the check points");
    const bool local = product_.solution.frame.has_value();
    chart_.draw_grid(svg, local ? "X (m)" : "east (m)", local ? "Y (m)" : "north (m)");
    svg.begin_clip("check-arrows", chart_.corner(), chart_.size());
    std::vector<Place> places;
    for (const Eigen::Vector2d& known : shown_.known_m) places.push_back(chart_.at(known));
    nameless_ = draw_labels(svg, places, shown_.names);
    svg.arrows(arrows(), "arrows check");
    svg.dots(places, "dots named");
    svg.end_clip();
    chart_.draw_scale_bar(svg);
    draw_scale_arrow(svg);
    return {svg.finish(), caption()};
  }

 private:
  void choose_factor() {
    std::vector<double> lengths_m;
    for (const Eigen::Vector2d& difference : shown_.difference_m)
      lengths_m.push_back(difference.norm());
    const double units = chart_.units_per_metre();
    const double fitting = exaggeration(lengths_m, units, 26, kLongest);
    std::sort(lengths_m.begin(), lengths_m.end());
    const double usual = kUsualFactor * units;
    const bool seen = usual * lengths_m[lengths_m.size() / 2] >= kShortestMedian;
    factor_ = seen && usual * lengths_m.back() <= kLongest ? kUsualFactor : fitting;
  }

  std::vector<Svg::Arrow> arrows() const {
    std::vector<Svg::Arrow> made;
    const double units = factor_ * chart_.units_per_metre();
    for (std::size_t i = 0; i < shown_.known_m.size(); ++i) {
      const Place from = chart_.at(shown_.known_m[i]);
      made.push_back(
          {from, from + units * Place(shown_.difference_m[i].x(), -shown_.difference_m[i].y())});
    }
    return made;
  }

  void draw_scale_arrow(Svg& svg) const {
    const double units = factor_ * chart_.units_per_metre();
    const double length_m = nice_below(110.0 / units);
    const Place left(chart_.corner().x() + 300, chart_.strip_top() + 14.5);
    svg.arrows({{left, left + Place(length_m * units, 0)}}, "arrows check");
    svg.text(left + Place(0, 18.5), "difference of " + significant(length_m, 1) + " m", "tick");
  }

  std::string caption() const {
    std::string words = "Differences in plan at the check points (measured minus known), arrows " +
                        exaggeration_words(factor_) + " against the ground.";
    if (product_.check->points.size() > shown_.known_m.size())
      words += " " + std::to_string(shown_.known_m.size()) + " of " +
               std::to_string(product_.check->points.size()) + " points are shown.";
    if (nameless_ > 0)
      words += " " + counted(nameless_, "name", "names") + " left out for want of room.";
    return words;
  }

  const Product& product_;
  Shown shown_;
  Chart chart_;
  double factor_ = kUsualFactor;
  int nameless_ = 0;
};

}  // namespace

Figure check_figure(const Product& product) {
  if (!product.check || product.check->points.empty() || !product.check->same_frame) return {};
  return CheckArrows(product).draw();
}

}  // namespace plumbline::deliver
