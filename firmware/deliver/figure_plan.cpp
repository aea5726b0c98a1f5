// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "edge/base/units.h"
#include "firmware/deliver/chart.h"
#include "firmware/deliver/figures.h"
#include "firmware/deliver/labels.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

constexpr std::size_t kTieEllipses = 120;
constexpr std::size_t kTieDots = 3000;

struct ErrorEllipse {
  Eigen::Vector2d semi_axes_m;  // larger first
  double turn_deg = 0;          // of the larger, clockwise on the paper from the x axis
};

std::vector<int> thinned(const std::vector<int>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<int> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

class Plan {
 public:
  Plan(const Product& product, EllipseKind kind)
      : product_(product), kind_(kind), kinds_(point_kinds(product)), chart_(make_chart()) {
    shown_ties_ = thinned(kinds_.ties, kTieEllipses);
    std::vector<double> lengths_m;
    for (const auto* list : {&kinds_.named, &shown_ties_})
      for (const int i : *list)
        if (const auto ellipse = ellipse_of(i)) lengths_m.push_back(ellipse->semi_axes_m[0]);
    factor_ = exaggeration(lengths_m, chart_.units_per_metre(), 13, 70);
  }

  Figure draw() {
    Svg svg(chart_.full_width(), chart_.full_height(),
            "Plan of points with error ellipses and of photo stations");
    chart_.draw_grid(svg, "east (m)", "north (m)");
    const std::string id = kind_ == EllipseKind::kLocal ? "plan-local" : "plan";
    svg.begin_clip(id, chart_.corner(), chart_.size());
    draw_points(svg);
    draw_stations(svg);
    svg.end_clip();
    draw_north_arrow(svg);
    chart_.draw_scale_bar(svg);
    draw_ellipse_bar(svg);
    draw_legend(svg);
    return {svg.finish(), caption()};
  }

 private:
  const orient::MeasuredPoint& point(int i) const {
    return product_.solution.points[static_cast<std::size_t>(i)];
  }
  Eigen::Vector2d plan_of(int i) const { return point(i).in_enu_m.head<2>(); }

  Chart make_chart() const {
    std::vector<Eigen::Vector2d> ties;
    std::vector<Eigen::Vector2d> wanted;
    for (const int i : kinds_.ties) ties.push_back(plan_of(i));
    for (const int i : kinds_.named) wanted.push_back(plan_of(i));
    for (const int i : oriented_photos(product_)) wanted.push_back(station(i));
    Box box = wanted.empty() ? box_around(ties, 0.02) : box_around(wanted, 0.0);
    if (!ties.empty()) box = joined(box, box_around(ties, 0.02));
    box = padded(box, 0.06);
    return Chart(box.low, box.high, 880, 600);
  }

  Eigen::Vector2d station(int photo) const {
    return product_.solution.photos[static_cast<std::size_t>(photo)].pose.centre_m.head<2>();
  }

  std::optional<ErrorEllipse> ellipse_of(int i) const {
    const Eigen::Matrix3d& full =
        kind_ == EllipseKind::kAbsolute ? point(i).covariance_m2 : point(i).local_covariance_m2;
    const Eigen::Matrix2d c = full.topLeftCorner<2, 2>();
    if (!c.allFinite() || !(c.trace() > 0.0)) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(c);
    const Eigen::Vector2d semi_m = modes.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
    const Eigen::Vector2d major = modes.eigenvectors().col(1);
    return ErrorEllipse{semi_m, -std::atan2(major.y(), major.x()) * kDegPerRad};
  }

  void draw_ellipse(Svg& svg, int i, const std::string& style) const {
    const auto ellipse = ellipse_of(i);
    if (!ellipse || !chart_.shows(plan_of(i))) return;
    svg.ellipse(chart_.at(plan_of(i)), factor_ * chart_.units_per_metre() * ellipse->semi_axes_m,
                ellipse->turn_deg, style);
  }

  void draw_points(Svg& svg) {
    std::vector<Place> ties;
    for (const int i : thinned(kinds_.ties, kTieDots))
      if (chart_.shows(plan_of(i))) ties.push_back(chart_.at(plan_of(i)));
    for (const int i : shown_ties_) draw_ellipse(svg, i, "ellipse tie");
    svg.dots(ties, "dots tie");
    for (const int i : kinds_.named) draw_ellipse(svg, i, "ellipse named");
    std::vector<Place> named;
    for (const int i : kinds_.named) named.push_back(chart_.at(plan_of(i)));
    svg.dots(named, "dots named");
    draw_names(svg, named);
  }

  void draw_names(Svg& svg, const std::vector<Place>& named) {
    std::vector<std::string> names;
    for (const int i : kinds_.named)
      names.push_back(product_.problem.point_names[static_cast<std::size_t>(i)]);
    nameless_ = draw_labels(svg, named, names);
  }

  void draw_stations(Svg& svg) const {
    std::vector<Place> path;
    for (const int i : oriented_photos(product_)) path.push_back(chart_.at(station(i)));
    svg.polyline(path, "climb");
    for (const Place& place : path) svg.triangle(place, 7, "station");
  }

  void draw_north_arrow(Svg& svg) const {
    const Place tip = chart_.corner() + Place(chart_.size().x() - 24, 16);
    svg.polygon({tip, tip + Place(7, 30), tip + Place(0, 23), tip + Place(-7, 30)}, "north");
    svg.text(tip + Place(0, 46), "N", "axis middle halo");
  }

  void draw_ellipse_bar(Svg& svg) const {
    const double scale = factor_ * chart_.units_per_metre();
    const double length_m = nice_below(70.0 / scale);
    const Place left(chart_.corner().x() + 250, chart_.strip_top() + 14.5);
    svg.line(left, left + Place(length_m * scale, 0), "sigma-bar");
    svg.text(left + Place(0, 18.5), "ellipses: " + significant(length_m, 1) + " m", "tick");
  }

  void draw_legend(Svg& svg) const {
    const Place at(chart_.corner().x() + 430, chart_.strip_top() + 15);
    if (!kinds_.named.empty()) {
      svg.ellipse(at, {13, 7}, -20, "ellipse named");
      svg.dots({at}, "dots named");
      svg.text(at + Place(20, 4), "named point", "tick");
    }
    if (!kinds_.ties.empty()) {
      svg.ellipse(at + Place(150, 0), {13, 7}, -20, "ellipse tie");
      svg.dots({at + Place(150, 0)}, "dots tie");
      svg.text(at + Place(170, 4), "tie point", "tick");
    }
    svg.triangle(at + Place(280, 0), 7, "station");
    svg.text(at + Place(293, 4), "photo station", "tick");
  }

  std::string caption() const {
    std::string words =
        kind_ == EllipseKind::kAbsolute
            ? "Plan, with one-sigma error ellipses in the frame of the result, "
            : "Plan, with one-sigma error ellipses of the shape alone (position, turn, tilt and "
              "scale of the whole set aside), ";
    words += exaggeration_words(factor_) + ".";
    if (kinds_.ties.size() > shown_ties_.size())
      words += " Ellipses of " + std::to_string(shown_ties_.size()) + " of " +
               std::to_string(kinds_.ties.size()) + " tie points.";
    if (nameless_ > 0)
      words += " " + counted(nameless_, "name", "names") + " left out for want of room.";
    return words;
  }

  const Product& product_;
  EllipseKind kind_;
  PointKinds kinds_;
  Chart chart_;
  std::vector<int> shown_ties_;
  double factor_ = 1;
  int nameless_ = 0;
};

}  // namespace

Figure plan_figure(const Product& product, EllipseKind kind) {
  const PointKinds kinds = point_kinds(product);
  if (kinds.named.empty() && kinds.ties.empty()) return {};
  return Plan(product, kind).draw();
}

}  // namespace plumbline::deliver
