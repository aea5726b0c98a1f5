// SPDX-License-Identifier: MIT
#include "firmware/deliver/svg.h"

#include <cmath>

#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

// To a tenth of a unit, shortest: a page holds thousands of these.
std::string coordinate(double value) {
  std::string text = fixed(value, 1);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string pair(const Place& place) { return coordinate(place.x()) + " " + coordinate(place.y()); }

std::string attribute(const std::string& name, double value) {
  return " " + name + "=\"" + coordinate(value) + "\"";
}

std::string style_of(const std::string& style) { return " class=\"" + style + "\"/>\n"; }

std::string points_of(const std::vector<Place>& places) {
  std::string text;
  for (const Place& place : places) text += (text.empty() ? "" : " ") + pair(place);
  return " points=\"" + text + "\"";
}

}  // namespace

Svg::Svg(double width, double height, const std::string& label)
    : head_("<svg viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) +
            "\" role=\"img\">\n" + "<title>" + escaped(label) + "</title>\n") {}

void Svg::line(const Place& from, const Place& to, const std::string& style) {
  body_ += "<line" + attribute("x1", from.x()) + attribute("y1", from.y()) +
           attribute("x2", to.x()) + attribute("y2", to.y()) + style_of(style);
}

void Svg::polyline(const std::vector<Place>& places, const std::string& style) {
  body_ += "<polyline" + points_of(places) + style_of(style);
}

void Svg::polygon(const std::vector<Place>& places, const std::string& style) {
  body_ += "<polygon" + points_of(places) + style_of(style);
}

void Svg::rectangle(const Place& corner, const Place& size, const std::string& style) {
  body_ += "<rect" + attribute("x", corner.x()) + attribute("y", corner.y()) +
           attribute("width", size.x()) + attribute("height", size.y()) + style_of(style);
}

void Svg::circle(const Place& centre, double radius, const std::string& style) {
  body_ += "<circle" + attribute("cx", centre.x()) + attribute("cy", centre.y()) +
           attribute("r", radius) + style_of(style);
}

void Svg::ellipse(const Place& centre, const Eigen::Vector2d& radii, double turn_deg,
                  const std::string& style) {
  body_ += "<ellipse" + attribute("rx", radii.x()) + attribute("ry", radii.y()) +
           " transform=\"translate(" + pair(centre) + ") rotate(" + coordinate(turn_deg) + ")\"" +
           style_of(style);
}

void Svg::triangle(const Place& centre, double size, const std::string& style) {
  polygon({centre + Place(0, -size), centre + Place(0.87 * size, 0.5 * size),
           centre + Place(-0.87 * size, 0.5 * size)},
          style);
}

void Svg::dots(const std::vector<Place>& places, const std::string& style) {
  if (places.empty()) return;
  body_ += "<path d=\"";
  for (const Place& place : places) body_ += "M" + pair(place) + "h0";
  body_ += "\"" + style_of(style);
}

void Svg::arrows(const std::vector<Arrow>& arrows, const std::string& style) {
  if (arrows.empty()) return;
  body_ += "<path d=\"";
  for (const Arrow& arrow : arrows) {
    body_ += "M" + pair(arrow.from) + "L" + pair(arrow.to);
    const Place along = arrow.to - arrow.from;
    if (along.norm() < 4.0) continue;
    const Place back = -along.normalized() * 3.5;
    const Place side(-0.5 * back.y(), 0.5 * back.x());
    body_ += "M" + pair(arrow.to + back + side) + "L" + pair(arrow.to) + "L" +
             pair(arrow.to + back - side);
  }
  body_ += "\"" + style_of(style);
}

void Svg::text(const Place& at, const std::string& words, const std::string& style) {
  body_ += "<text" + attribute("x", at.x()) + attribute("y", at.y()) + " class=\"" + style + "\">" +
           escaped(words) + "</text>\n";
}

void Svg::begin_clip(const std::string& id, const Place& corner, const Place& size) {
  body_ += "<clipPath id=\"" + id + "\"><rect" + attribute("x", corner.x()) +
           attribute("y", corner.y()) + attribute("width", size.x()) +
           attribute("height", size.y()) + "/></clipPath>\n<g clip-path=\"url(#" + id + ")\">\n";
}

void Svg::end_clip() { body_ += "</g>\n"; }

std::string Svg::finish() const { return head_ + body_ + "</svg>\n"; }

double nice_below(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double lead = value / decade * (1.0 + 1e-12);
  return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * decade;
}

}  // namespace plumbline::deliver
