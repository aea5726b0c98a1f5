// SPDX-License-Identifier: MIT
#include "firmware/deliver/chart.h"

#include <algorithm>
#include <cmath>

#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

constexpr double kLeft = 62;
constexpr double kRight = 14;
constexpr double kTop = 12;
constexpr double kAxis = 40;
constexpr double kStrip = 62;

std::string bar_words(double metres) {
  if (metres >= 1000.0) return significant(metres / 1000.0, 1) + " km";
  return metres >= 1.0 ? fixed(metres, 0) + " m" : significant(metres, 1) + " m";
}

// As nice_below(), with 3 as well: a factor need not divide a grid.
double round_factor_below(double value) {
  const double factor = nice_below(value);
  return nice_below(value / 3.0) * 3.0 > factor ? nice_below(value / 3.0) * 3.0 : factor;
}

// Decimals that a coordinate at multiples of `step` needs.
int decimals_for(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
}

}  // namespace

Chart::Chart(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m, double width,
             double max_height)
    : corner_(kLeft, kTop) {
  const Eigen::Vector2d span_m = (high_m - low_m).cwiseMax(1e-3);
  units_per_metre_ = std::min(width / span_m.x(), max_height / span_m.y());
  const double height = std::max(units_per_metre_ * span_m.y(), 0.4 * max_height);
  size_ = Place(width, height);
  const Eigen::Vector2d centre_m = 0.5 * (low_m + high_m);
  low_m_ = centre_m - 0.5 * size_ / units_per_metre_;
  high_m_ = centre_m + 0.5 * size_ / units_per_metre_;
}

Place Chart::at(const Eigen::Vector2d& ground_m) const {
  return corner_ + units_per_metre_ * Place(ground_m.x() - low_m_.x(), high_m_.y() - ground_m.y());
}

double Chart::full_width() const { return corner_.x() + size_.x() + kRight; }
double Chart::strip_top() const { return corner_.y() + size_.y() + kAxis; }
double Chart::full_height() const { return strip_top() + kStrip; }

bool Chart::shows(const Eigen::Vector2d& ground_m) const {
  return (ground_m.array() >= low_m_.array()).all() && (ground_m.array() <= high_m_.array()).all();
}

void Chart::draw_grid(Svg& svg, const std::string& x_name, const std::string& y_name) const {
  const double step_m = nice_below(130.0 / units_per_metre_);
  const int decimals = decimals_for(step_m);
  const Place end = corner_ + size_;
  svg.rectangle(corner_, size_, "ground");
  for (double x = std::ceil(low_m_.x() / step_m) * step_m; x <= high_m_.x(); x += step_m) {
    const double u = at({x, low_m_.y()}).x();
    svg.line({u, corner_.y()}, {u, end.y()}, "grid");
    svg.text({u, end.y() + 16}, fixed(x, decimals), "tick middle");
  }
  for (double y = std::ceil(low_m_.y() / step_m) * step_m; y <= high_m_.y(); y += step_m) {
    const double v = at({low_m_.x(), y}).y();
    svg.line({corner_.x(), v}, {end.x(), v}, "grid");
    svg.text({corner_.x() - 7, v + 4}, fixed(y, decimals), "tick end");
  }
  svg.text({end.x(), end.y() + 33}, x_name, "axis end");
  svg.text({corner_.x() + 8, corner_.y() + 18}, y_name, "axis halo");
}

void Chart::draw_scale_bar(Svg& svg) const {
  const double length_m = nice_below(180.0 / units_per_metre_);
  const double units = length_m * units_per_metre_;
  const Place left(corner_.x(), strip_top() + 12);
  svg.rectangle(left, {0.5 * units, 5}, "bar");
  svg.rectangle(left + Place(0.5 * units, 0), {0.5 * units, 5}, "bar open");
  svg.text(left + Place(0, 21), "0", "tick middle");
  svg.text(left + Place(units, 21), bar_words(length_m), "tick middle");
}

Box box_around(const std::vector<Eigen::Vector2d>& places, double outer_share) {
  Box box;
  for (int axis = 0; axis < 2 && !places.empty(); ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector2d& place : places) values.push_back(place[axis]);
    std::sort(values.begin(), values.end());
    const auto skip = static_cast<std::size_t>(outer_share * static_cast<double>(values.size()));
    box.low[axis] = values[skip];
    box.high[axis] = values[values.size() - 1 - skip];
  }
  return box;
}

Box joined(const Box& a, const Box& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }

Box padded(const Box& box, double share) {
  const double by = std::max(share * (box.high - box.low).maxCoeff(), 0.5);
  return {box.low.array() - by, box.high.array() + by};
}

double exaggeration(const std::vector<double>& lengths_m, double units_per_metre,
                    double median_units, double largest_units) {
  std::vector<double> finite;
  for (const double length : lengths_m)
    if (std::isfinite(length) && length > 0.0) finite.push_back(length * units_per_metre);
  if (finite.empty()) return 1.0;
  const double largest = *std::max_element(finite.begin(), finite.end());
  return round_factor_below(std::min(median_units / median_of(finite), largest_units / largest));
}

std::string exaggeration_words(double factor) {
  if (factor < 1.0) return "reduced to " + significant(factor, 1);
  return factor == 1.0 ? "to scale" : "enlarged " + significant(factor, 1) + " times";
}

}  // namespace plumbline::deliver
