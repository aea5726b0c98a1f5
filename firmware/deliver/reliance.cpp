// SPDX-License-Identifier: MIT
#include "firmware/deliver/reliance.h"

#include <algorithm>
#include <cmath>

#include "edge/base/units.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

// Beyond so many times the sigma of the shape, a common error governs the absolute figures.
constexpr double kGoverns = 3.0;
// Common errors below this leave a coordinate usable as it stands (Japan's manual for surveys by
// drone has position classes of 0.05, 0.10 and 0.20 m), however much better the shape is.
constexpr double kUsableM = 0.10;

struct Known {
  int stations = 0;
  double station_sigma_m = 0;  // median of the horizontal ones
  bool control = false;
  bool lengths = false;
  bool heading = false;
};

Known known_of(const Product& product) {
  Known known;
  std::vector<double> sigmas_m;
  for (const orient::Photo& photo : product.problem.photos) {
    if (photo.heading) known.heading = true;
    if (!photo.station) continue;
    ++known.stations;
    sigmas_m.push_back(std::sqrt(0.5 * photo.station->covariance_m2.topLeftCorner<2, 2>().trace()));
  }
  const double offset_m = product.problem.gnss.offset_sigma_horizontal_m;
  known.station_sigma_m = std::hypot(median_of(sigmas_m), offset_m);
  known.control = !product.problem.control.empty();
  known.lengths = !product.problem.lengths.empty();
  return known;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

std::string gnss_words(const Known& known) {
  return "GNSS positions (sigma " + length_words(known.station_sigma_m) + ")";
}

std::string rests_on(const Known& known, bool lengths_help, bool heading_helps) {
  std::vector<std::string> parts;
  if (known.control) parts.push_back("control points");
  if (known.lengths && lengths_help) parts.push_back("known lengths");
  if (known.heading && heading_helps) parts.push_back("the heading given");
  if (known.stations > 0) parts.push_back(gnss_words(known));
  if (parts.empty()) return "nothing";
  return joined(parts) + (parts.size() == 1 ? " alone" : "");
}

bool named_unobservable(const Product& product, const std::string& name) {
  const auto& list = product.solution.summary.unobservable;
  return std::any_of(list.begin(), list.end(),
                     [&](const orient::Unobservable& item) { return item.name == name; });
}

// What the shape alone is good to: the median sigma about the best-fit frame, metres.
struct ShapeSigma {
  double plan_m = 0;
  double height_m = 0;
};

ShapeSigma shape_sigma(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  const auto& points = kinds.named.empty() ? kinds.ties : kinds.named;
  auto shape = local_sigma_figures(product, points);
  if (!shape) shape = sigma_figures(product, points);
  if (!shape) return {};
  return {shape->median.head<2>().norm() / std::sqrt(2.0), shape->median.z()};
}

// `effect_m`: of the common error on a point; `shape_m`: what it is compared with.
Trust trust_of(const Product& product, const std::string& name, double effect_m, double shape_m) {
  if (named_unobservable(product, name) || !std::isfinite(effect_m)) return Trust::kNotFixed;
  const double limit_m = std::max(kGoverns * shape_m, kUsableM);
  return effect_m > limit_m ? Trust::kRelativeOnly : Trust::kFixed;
}

Reliance position(const Product& product, const Known& known) {
  const double sigma_m = product.solution.summary.common.position_m;
  Reliance r{"Position of the whole", std::isfinite(sigma_m) ? length_words(sigma_m) : "not fixed",
             rests_on(known, false, false),
             trust_of(product, "position", sigma_m, shape_sigma(product).plan_m), ""};
  if (!std::isfinite(sigma_m) || (known.stations == 0 && !known.control))
    r.meaning = "Coordinates hold only relative to each other: nothing ties them to the earth.";
  else if (r.trust == Trust::kFixed)
    r.meaning = "Coordinates may be used as they stand, within their sigmas.";
  else
    r.meaning = "Coordinates hold only relative to each other: all of them together may be " +
                length_words(sigma_m) + " (one sigma) away from where they are stated.";
  return r;
}

Reliance turned(const Product& product, const Known& known, bool azimuth) {
  const orient::CommonSigmas& common = product.solution.summary.common;
  const double sigma_rad = azimuth ? common.azimuth_rad : common.tilt_rad;
  const double reach = std::max(reach_m(product), 1.0);
  const double effect_m = sigma_rad * reach;
  const ShapeSigma shape = shape_sigma(product);
  const std::string at = " at " + fixed(reach, 0) + " m from the foot";
  Reliance r{azimuth ? "Azimuth of the whole" : "Tilt of the whole",
             fixed_or(sigma_rad * kDegPerRad, 3, "not fixed"), rests_on(known, false, azimuth),
             trust_of(product, azimuth ? "azimuth" : "tilt", effect_m,
                      azimuth ? shape.plan_m : shape.height_m),
             ""};
  if (std::isfinite(sigma_rad)) r.sigma += "\xc2\xb0";
  const std::string what = azimuth ? "Bearings" : "Height differences across the area";
  if (r.trust == Trust::kFixed)
    r.meaning = "Moves a point by " + length_words(effect_m) + at + " (one sigma).";
  else if (r.trust == Trust::kRelativeOnly)
    r.meaning = what + " are weak: a turn of the whole moves a point by " + length_words(effect_m) +
                at + " (one sigma).";
  else
    r.meaning = what + " must not be used: nothing fixes this turn of the whole well enough.";
  return r;
}

Reliance scale(const Product& product, const Known& known) {
  const double sigma = product.solution.summary.common.scale;
  const double effect_m = sigma * std::max(reach_m(product), 1.0);
  Reliance r{"Scale", std::isfinite(sigma) ? significant(100.0 * sigma, 2) + " %" : "not fixed",
             rests_on(known, true, false),
             trust_of(product, "scale", effect_m, shape_sigma(product).plan_m), ""};
  if (r.trust == Trust::kNotFixed)
    r.meaning = "Lengths, areas and volumes must not be used: only ratios and angles hold.";
  else
    r.meaning = (r.trust == Trust::kFixed ? "A length of 10 m is good to "
                                          : "Lengths are weak: one of 10 m is good only to ") +
                length_words(10.0 * sigma) + " from scale.";
  return r;
}

Reliance focal_length(const Product& product) {
  const double sigma = product.solution.summary.common.focal_length;
  const bool lost = named_unobservable(product, "focal_length") || !std::isfinite(sigma);
  Reliance r{"Focal length",
             std::isfinite(sigma) ? significant(100.0 * sigma, 2) + " %" : "not fixed",
             "the camera file and the photos", lost ? Trust::kNotFixed : Trust::kFixed, ""};
  r.meaning = lost ? "Heights against plan are not to be trusted beyond this share; a calibrated "
                     "camera mends it."
                   : "Its effect is contained in the sigmas of the points.";
  return r;
}

Reliance height(const Product& product) {
  const double sigma = product.solution.summary.common.height;
  const double flying_m = product.solution.summary.flying_height_m;
  const bool lost = named_unobservable(product, "height") || !std::isfinite(sigma);
  Reliance r{"Height of a point (median)",
             std::isfinite(sigma) ? length_words(sigma * flying_m) : "not fixed",
             "parallax between the stations", lost ? Trust::kNotFixed : Trust::kFixed, ""};
  r.meaning = lost ? "Heights must not be used: the stations give too little parallax."
                   : "That is " + significant(100.0 * sigma, 2) + " % of the flying height.";
  return r;
}

}  // namespace

std::vector<Reliance> reliances(const Product& product) {
  const Known known = known_of(product);
  return {position(product, known), turned(product, known, true), turned(product, known, false),
          scale(product, known),    focal_length(product),        height(product)};
}

std::vector<std::string> relative_only(const Product& product) {
  std::vector<std::string> sentences;
  for (const Reliance& r : reliances(product))
    if (r.trust != Trust::kFixed)
      sentences.push_back(r.quantity + " (sigma " + r.sigma + ", rests on " + r.rests_on +
                          "): " + r.meaning);
  return sentences;
}

}  // namespace plumbline::deliver
