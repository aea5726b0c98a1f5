// SPDX-License-Identifier: MIT
#include "firmware/commands/derived_figures.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "edge/orient/derived.h"
#include "firmware/ingest/number.h"

namespace plumbline::commands {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// Indices of the points by their names.
Result<std::vector<int>> points_of(const std::vector<std::string>& names, const std::string& option,
                                   const deliver::Product& product) {
  const auto& known = product.problem.point_names;
  std::vector<int> points;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    const auto index = static_cast<std::size_t>(found - known.begin());
    if (found == known.end() || !product.solution.points[index].measured) {
      std::string sentence = option;
      sentence.append(": the point \"").append(name);
      return Error{sentence.append("\" was not measured; name points of points.csv.")};
    }
    points.push_back(static_cast<int>(index));
  }
  return points;
}

using Compute = Result<orient::Derived> (*)(const orient::Solution&, const std::vector<int>&,
                                            double level_m);

struct Kind {
  const char* name;
  const char* unit;
  std::size_t least_points, most_points;
  Compute compute;
};

constexpr Kind kDistance = {"distance", "m", 2, 2,
                            [](const orient::Solution& s, const std::vector<int>& p, double) {
                              return orient::distance(s, p[0], p[1]);
                            }};
constexpr Kind kArea = {"area", "m2", 3, SIZE_MAX,
                        [](const orient::Solution& s, const std::vector<int>& p, double) {
                          return orient::area(s, p);
                        }};
constexpr Kind kVolume = {"volume", "m3", 3, SIZE_MAX,
                          [](const orient::Solution& s, const std::vector<int>& p, double level) {
                            return orient::volume(s, p, level);
                          }};

// The level behind the @ of a volume, taken off `text`.
Result<double> take_level(std::string& text) {
  constexpr double kMostM = 100'000;  // no ground lies higher or deeper
  const std::size_t mark = text.rfind('@');
  const auto level = ingest::parse_number(mark == std::string::npos ? "" : text.substr(mark + 1));
  if (!level) return Error{"the level is missing; write A,B,C,...@LEVEL in metres."};
  if (std::abs(*level) > kMostM) return Error{"the level is more than 100 km; give it in metres."};
  text.resize(mark);
  return *level;
}

// Empty where there is none.
std::string named_twice(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto found = std::adjacent_find(names.begin(), names.end());
  return found == names.end() ? "" : *found;
}

Status add_figure(const Kind& kind, std::string text, deliver::Product& product) {
  const std::string option = std::string("--") + kind.name + " " + text;
  deliver::DerivedFigure figure{kind.name, {}, std::nullopt, std::nullopt, kind.unit};
  if (kind.name == kVolume.name) {
    const auto level = take_level(text);
    if (!level) return Error{option + ": " + level.error().sentence};
    figure.level_m = *level;
  }
  figure.points = split(text);
  if (figure.points.size() < kind.least_points || figure.points.size() > kind.most_points) {
    return Error{option + ": " + (kind.most_points == 2 ? "two points" : "three points or more") +
                 " are wanted, with commas between them."};
  }
  if (const std::string name = named_twice(figure.points); !name.empty())
    return Error{option + ": the point \"" + name + "\" is named twice."};
  const auto points = points_of(figure.points, option, product);
  if (!points) return points.error();
  const auto value = kind.compute(product.solution, *points, figure.level_m.value_or(0));
  if (!value) return Error{option + ": " + value.error().sentence};
  if (std::isfinite(product.solution.summary.common.scale)) figure.value = *value;
  product.derived.push_back(std::move(figure));
  return Done{};
}

}  // namespace

void add_derived_options(CLI::App& sub, DerivedArguments& arguments) {
  const auto add = [&sub](const char* name, std::vector<std::string>& values, const char* what) {
    sub.add_option(name, values, what)->take_all()->allow_extra_args(false);
  };
  add("--distance", arguments.distances, "between two measured points, with its sigma: A,B");
  add("--area", arguments.areas, "of a polygon of measured points, seen from above: A,B,C,...");
  add("--volume", arguments.volumes,
      "between the surface over a polygon of measured points and a level, metres: A,B,C,...@LEVEL");
}

Status add_derived_figures(const DerivedArguments& arguments, deliver::Product& product) {
  const std::pair<const Kind&, const std::vector<std::string>&> wanted[] = {
      {kDistance, arguments.distances}, {kArea, arguments.areas}, {kVolume, arguments.volumes}};
  for (const auto& [kind, texts] : wanted) {
    for (const std::string& text : texts) {
      if (auto status = add_figure(kind, text, product); !status) return status;
    }
  }
  return Done{};
}

Status add_check(const std::vector<survey::CheckPoint>& known, deliver::Product& product) {
  const orient::Problem& problem = product.problem;
  const auto is_control = [&](const survey::CheckPoint& point) {
    return std::any_of(problem.control.begin(), problem.control.end(), [&](const auto& control) {
      return problem.point_names[static_cast<std::size_t>(control.point)] == point.point;
    });
  };
  if (known.empty()) return Done{};
  if (std::all_of(known.begin(), known.end(), is_control)) {
    product.warnings.emplace_back(
        "All check points were control points of the adjustment: nothing independent is left to "
        "compare with.");
    return Done{};
  }
  auto check = survey::check(problem, product.solution, known);
  if (!check) return check.error();
  product.check = std::move(*check);
  return Done{};
}

}  // namespace plumbline::commands
