// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "edge/base/units.h"
#include "firmware/deliver/chart.h"
#include "firmware/deliver/figures.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

constexpr std::size_t kTieBars = 400;

// The horizontal direction in which the stations lie apart; east where they stand in one place.
Eigen::Vector2d section_direction(const Product& product) {
  const Eigen::Vector2d foot = foot_in_enu_m(product).head<2>();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const int i : oriented_photos(product)) {
    const Eigen::Vector2d off =
        product.solution.photos[static_cast<std::size_t>(i)].pose.centre_m.head<2>() - foot;
    spread += off * off.transpose();
  }
  if (spread.trace() < 1.0) return Eigen::Vector2d::UnitX();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(spread);
  const Eigen::Vector2d along = modes.eigenvectors().col(1);
  const bool forward = std::abs(along.x()) > 1e-9 ? along.x() > 0 : along.y() > 0;
  return forward ? along : Eigen::Vector2d(-along);
}

class Section {
 public:
  explicit Section(const Product& product)
      : product_(product),
        kinds_(point_kinds(product)),
        foot_(foot_in_enu_m(product)),
        along_(section_direction(product)),
        chart_(make_chart()) {
    const std::size_t step = kinds_.ties.size() / kTieBars + 1;
    for (std::size_t i = 0; i < kinds_.ties.size(); i += step) ties_.push_back(kinds_.ties[i]);
    std::vector<double> sigmas_m;
    for (const auto* list : {&kinds_.named, &ties_})
      for (const int i : *list) sigmas_m.push_back(sigma_up_m(i));
    factor_ = exaggeration(sigmas_m, chart_.units_per_metre(), 12, 60);
  }

  Figure draw() const {
    Svg svg(chart_.full_width(), chart_.full_height(),
            "Vertical section with photo stations and heights of points");
    chart_.draw_grid(svg, "along azimuth " + azimuth_words() + ", from the foot (m)", "up (m)");
    svg.begin_clip("section", chart_.corner(), chart_.size());
    draw_fans(svg);
    draw_bars(svg, ties_, "height tie");
    draw_bars(svg, kinds_.named, "height named");
    draw_dots(svg, ties_, "dots tie");
    draw_dots(svg, kinds_.named, "dots named");
    svg.end_clip();
    draw_stations(svg);
    chart_.draw_scale_bar(svg);
    draw_sigma_bar(svg);
    draw_legend(svg);
    return {svg.finish(), "Section, seen across azimuth " + azimuth_words() +
                              ": what each station has seen of the ground, and the heights of the "
                              "points with their standard deviations, " +
                              exaggeration_words(factor_) + "."};
  }

 private:
  const orient::MeasuredPoint& point(int i) const {
    return product_.solution.points[static_cast<std::size_t>(i)];
  }
  Eigen::Vector2d in_section(const Eigen::Vector3d& place) const {
    return {along_.dot((place - foot_).head<2>()), place.z()};
  }
  Eigen::Vector2d station(int photo) const {
    return in_section(product_.solution.photos[static_cast<std::size_t>(photo)].pose.centre_m);
  }
  double sigma_up_m(int i) const { return std::sqrt(point(i).covariance_m2(2, 2)); }

  std::string azimuth_words() const {
    const double azimuth_deg = std::atan2(along_.x(), along_.y()) * kDegPerRad;
    return fixed(azimuth_deg, 0) + "\xc2\xb0";
  }

  Chart make_chart() const {
    std::vector<Eigen::Vector2d> ties;
    std::vector<Eigen::Vector2d> wanted = {Eigen::Vector2d(0, foot_.z())};
    for (const int i : kinds_.ties) ties.push_back(in_section(point(i).in_enu_m));
    for (const int i : kinds_.named) wanted.push_back(in_section(point(i).in_enu_m));
    for (const int i : oriented_photos(product_)) wanted.push_back(station(i));
    Box box = box_around(wanted, 0.0);
    if (!ties.empty()) box = joined(box, box_around(ties, 0.02));
    box = padded(box, 0.06);
    return Chart(box.low, box.high, 880, 520);
  }

  // The outermost of the points that each photo has used.
  std::map<int, std::pair<Eigen::Vector2d, Eigen::Vector2d>> outermost_seen() const {
    std::map<int, std::pair<Eigen::Vector2d, Eigen::Vector2d>> seen;
    for (std::size_t k = 0; k < product_.problem.observations.size(); ++k) {
      const orient::Observation& observation = product_.problem.observations[k];
      if (!product_.solution.residuals[k].used || !point(observation.point).measured) continue;
      const Eigen::Vector2d place = in_section(point(observation.point).in_enu_m);
      const auto [entry, fresh] = seen.try_emplace(observation.photo, place, place);
      if (!fresh && place.x() < entry->second.first.x()) entry->second.first = place;
      if (!fresh && place.x() > entry->second.second.x()) entry->second.second = place;
    }
    return seen;
  }

  void draw_fans(Svg& svg) const {
    for (const auto& [photo, ends] : outermost_seen()) {
      if (!product_.solution.photos[static_cast<std::size_t>(photo)].oriented) continue;
      svg.polygon({chart_.at(station(photo)), chart_.at(ends.first), chart_.at(ends.second)},
                  "fan");
    }
  }

  void draw_bars(Svg& svg, const std::vector<int>& points, const std::string& style) const {
    for (const int i : points) {
      const double sigma_m = sigma_up_m(i);
      const Eigen::Vector2d place = in_section(point(i).in_enu_m);
      if (!std::isfinite(sigma_m) || !chart_.shows(place)) continue;
      const Place half(0, factor_ * sigma_m * chart_.units_per_metre());
      svg.line(chart_.at(place) - half, chart_.at(place) + half, style);
    }
  }

  void draw_dots(Svg& svg, const std::vector<int>& points, const std::string& style) const {
    std::vector<Place> places;
    for (const int i : points) places.push_back(chart_.at(in_section(point(i).in_enu_m)));
    svg.dots(places, style);
  }

  void draw_stations(Svg& svg) const {
    std::vector<Place> path;
    for (const int i : oriented_photos(product_)) path.push_back(chart_.at(station(i)));
    svg.polyline(path, "climb");
    for (const Place& place : path) svg.triangle(place, 7, "station");
  }

  void draw_sigma_bar(Svg& svg) const {
    const double scale = factor_ * chart_.units_per_metre();
    const double length_m = nice_below(40.0 / scale);
    const Place top(chart_.corner().x() + 250, chart_.strip_top() + 2);
    svg.line(top, top + Place(0, length_m * scale), "sigma-bar");
    svg.text(top + Place(9, 18), "heights: " + significant(length_m, 1) + " m", "tick");
  }

  void draw_legend(Svg& svg) const {
    const Place at(chart_.corner().x() + 430, chart_.strip_top() + 15);
    if (!kinds_.named.empty()) {
      svg.line(at - Place(0, 10), at + Place(0, 10), "height named");
      svg.dots({at}, "dots named");
      svg.text(at + Place(12, 4), "named point", "tick");
    }
    if (!kinds_.ties.empty()) {
      svg.line(at + Place(150, -10), at + Place(150, 10), "height tie");
      svg.dots({at + Place(150, 0)}, "dots tie");
      svg.text(at + Place(162, 4), "tie point", "tick");
    }
    svg.triangle(at + Place(280, 0), 7, "station");
    svg.text(at + Place(293, 4), "photo station", "tick");
  }

  const Product& product_;
  PointKinds kinds_;
  Eigen::Vector3d foot_;
  Eigen::Vector2d along_;
  Chart chart_;
  std::vector<int> ties_;
  double factor_ = 1;
};

}  // namespace

Figure section_figure(const Product& product) {
  if (oriented_photos(product).empty()) return {};
  return Section(product).draw();
}

}  // namespace plumbline::deliver
